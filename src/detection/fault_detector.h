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
  int window = 50;  ///< [samples] number of measured outputs per decision, 10 to 100000
  double false_alarm_rate = 0.01;  ///< share of fault-free windows that raise an alarm, 1e-9 to 0.5
  /// What is assumed about the plant's state when an experiment begins; absent: the same as in the
  /// identification.
  std::optional<InitialState> initial_state;
  /// For initial_state discard; kAutomatic: as in the identification.
  int discard_samples = kAutomatic;
  /// Account for the estimation errors of theta, of the mixture and of the noise variance.
  bool parameter_uncertainty = true;

  /// Throws ConfigurationError naming key, value and allowed range.
  void validate() const;
};

/// The decision about one window.
struct FaultWindow {
  long first = 0, last = 0;  ///< the window's samples, counted from 0 at the experiment's begin
  double statistic = 0;      ///< -log10 of the probability that a fault-free window is as extreme
  double threshold = 0;      ///< -log10 of the false-alarm rate
  bool fault = false;        ///< statistic > threshold
  WindowProbabilities probabilities;            ///< p-values of the single tests
  std::vector<double> component_probabilities;  ///< of the mixture's components, after the window
  Eigen::VectorXd error_mean;                   ///< posterior mean of xi, after the window
};

/// Decides from a stream of samples whether the plant still agrees with the identified model.
///
/// The error parameters xi of the running experiment are estimated recursively (ErrorFilter). Each
/// sample gets a score from its predictive distribution; without a fault the scores are independent
/// and N(0, 1). Consecutive windows of scores are tested (testWindow()). After a window with an
/// alarm the estimate of xi returns to its value before that window. Otherwise the filter would
/// learn the fault as an error of the model, and the alarm would end before the fault does.
///
/// xi belongs to one experiment, so call reset() when another begins. A fault that is present from
/// the first sample and has the same effect as a probable xi cannot be detected.
class FaultDetector {
 public:
  /// Throws ConfigurationError for options out of range or, where the error model varies Go's
  /// parameters, a configuration that is not the result's, DataError for an estimate that is not
  /// usable or whose noise variance is not positive.
  explicit FaultDetector(const Estimate& estimate, const FaultDetectionOptions& options = {});

  /// Begins a new experiment: forgets the plant's state and the estimate of xi.
  void reset();

  /// Processes the next sample of the uniform grid; y is NaN if it was not measured. Returns a
  /// decision when this sample completes a window.
  /// Throws DataError for a u that is not finite.
  std::optional<FaultWindow> add(double u, double y);

  double sampleTime() const { return sample_time_; }  ///< [s]
  double threshold() const { return threshold_; }

  /// Messages for the user about the model, one sentence each.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  void warnAboutSpread(const Estimate& estimate);
  void prepareParameters(const Estimate& estimate);
  Score score(double u, double y);
  FaultWindow decide();

  FaultDetectionOptions options_;
  EstimationOptions estimation_;
  double sample_time_, offset_u_, offset_y_, noise_variance_, threshold_;
  double noise_degrees_;  ///< degrees of freedom of the estimated noise variance
  Mixture mixture_;
  /// The model at theta_hat, followed by a pair for each direction of its estimation errors: one at
  /// a positive and one at a negative step along it. Their differences give derivatives.
  std::vector<StreamModel> models_;
  std::vector<std::string> warnings_;

  std::vector<WhitenedStream> streams_;  ///< one per element of models_
  WhitenedObservation observation_;
  double signature_ = 0;  ///< whitened output of the nominal model for the newest sample
  std::optional<ErrorFilter> learned_,
      tentative_;  ///< up to the window's begin, and including the window's samples so far
  Eigen::VectorXd scores_;
  Eigen::MatrixXd
      effects_;  ///< W x 2: effect of the nominal output and its predecessor on the scores
  int filled_ = 0;
  long samples_ = 0, window_first_ = 0;
};

}  // namespace uncertainty_identification
