#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "detection/error_filter.h"
#include "detection/whitened_stream.h"
#include "detection/window_tests.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// How faults are detected.
struct FaultDetectionOptions {
  int window = 50;  ///< [samples] measured outputs that one decision is made from, 10 to 100000
  double false_alarm_rate = 0.01;  ///< share of windows without a fault that raise an alarm, 1e-9
                                   ///< to 0.5
  /// What is known of the plant when an experiment begins; absent: as the model was identified.
  std::optional<InitialState> initial_state;
  int discard_samples = kAutomatic;  ///< initial_state: discard; kAutomatic: as identified
  bool parameter_uncertainty =
      true;  ///< count with the errors of theta, mixture and noise variance

  /// Throws ConfigurationError naming key, value and allowed range.
  void validate() const;
};

/// The decision about one window.
struct FaultWindow {
  long first = 0, last = 0;  ///< samples since the experiment began, from 0; the window's
  double statistic = 0;      ///< -log10 of the probability of such a window without a fault
  double threshold = 0;      ///< -log10 of the false-alarm rate
  bool fault = false;        ///< statistic > threshold
  WindowProbabilities probabilities;            ///< of the single tests
  std::vector<double> component_probabilities;  ///< of the mixture, after the window
  Eigen::VectorXd error_mean;                   ///< posterior mean of xi, after the window
};

/// Tells from a stream of samples whether a plant still is one that the identified model allows.
///
/// Each sample is predicted under every component of the mixture, the error parameters xi of the
/// running experiment being estimated recursively, and scored by its predictive distribution: the
/// scores are independent N(0, 1) without a fault. Windows of them, one after the other, are tested
/// (testWindow()). Samples of a window in alarm are not learned from: the estimate of xi goes back
/// to that before the window, so that a fault is not taken for an error of the model and the alarm
/// stays until the fault is gone.
///
/// xi belongs to one experiment: call reset() when another begins. A fault that is there from the
/// first sample and looks like a probable xi cannot be told from it.
class FaultDetector {
 public:
  /// Throws ConfigurationError for options out of range or an error model of basis
  /// parameter_spread, DataError for an estimate that is not usable or whose noise variance is not
  /// positive.
  explicit FaultDetector(const Estimate& estimate, const FaultDetectionOptions& options = {});

  /// Begins a new experiment: of the plant's state and of xi nothing is known but the model.
  void reset();

  /// Takes the next sample of the grid; y NaN: not measured. A decision where a window is complete.
  /// Throws DataError for a u that is not finite.
  std::optional<FaultWindow> add(double u, double y);

  double sampleTime() const { return sample_time_; }  ///< [s]
  double threshold() const { return threshold_; }

  /// What a user should know of the model, one sentence each.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  void prepareParameters(const Estimate& estimate);
  Score score(double u, double y);
  FaultWindow decide();

  FaultDetectionOptions options_;
  EstimationOptions estimation_;
  double sample_time_, offset_u_, offset_y_, noise_variance_, threshold_;
  double noise_degrees_;  ///< of freedom of the noise variance
  Mixture mixture_;
  /// At theta_hat, then in pairs at a step ahead and back along each direction of its errors.
  std::vector<StreamModel> models_;
  std::vector<std::string> warnings_;

  std::vector<WhitenedStream> streams_;  ///< one for each of models_
  WhitenedObservation observation_;
  double signature_ = 0;  ///< effect of the nominal model on the newest sample, whitened
  std::optional<ErrorFilter> learned_, tentative_;  ///< before and within the window
  Eigen::VectorXd scores_;
  Eigen::MatrixXd effects_;  ///< of the nominal output, now and a sample ago, on the scores
  int filled_ = 0;
  long samples_ = 0, window_first_ = 0;
};

}  // namespace uncertainty_identification
