#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "detection/fault_detector.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/recording.h"

namespace uncertainty_identification {

/// All settings of a fault detector for live signals.
struct FaultDetectionConfiguration {
  FaultDetectionOptions detection;
  SignalOptions input{"", "actuator/command", "auto"};
  SignalOptions output{"", "sensor/measurement", "auto"};
  std::string experiment_topic;  ///< topic of std_msgs/Bool or ExperimentMarker that begins and
                                 ///< ends experiments; empty: one experiment without an end
  ResamplingOptions resampling;

  /// Throws ConfigurationError naming key, value and allowed range.
  void validate() const;
};

/// A decision, and the time of its window.
struct StampedFaultWindow {
  FaultWindow window;
  double start = 0, end = 0;  ///< [s] sampling instants of the window's first and last sample
};

/// A fault detector for stamped signals, which arrive in consecutive pieces. Each piece is put on a
/// uniform grid by resample(). Grid points between two pieces count as not measured. Where the
/// model was fitted to each so manieth sample, so is each so manieth tested
/// (EstimationOptions::thinning).
class LiveFaultDetector {
 public:
  /// Throws the same exceptions as FaultDetector.
  LiveFaultDetector(const Estimate& estimate, const FaultDetectionConfiguration& configuration);

  /// Judges the samples that come by this estimate from now on, in new windows. Markers and signals
  /// stay. Throws the same exceptions as FaultDetector; nothing has changed then.
  void adopt(const Estimate& estimate);

  /// An active marker begins an experiment at `stamp` [s], another one ends it. Markers apply to
  /// samples that are added later. Without an experiment topic the only experiment begins with the
  /// first sample.
  void addMarker(double stamp, bool active);

  /// Processes the next piece and returns the decisions about the windows that it completes. Throws
  /// DataError like resample(); the piece is then left out.
  std::vector<StampedFaultWindow> add(const Recording& piece);

  /// The signals were interrupted: the next piece begins a new experiment.
  void interrupt();

  /// [s] how long a piece should be: a fifth of a window, but at least 10 samples.
  double pieceDuration() const { return piece_samples_ * sample_time_; }

  const FaultDetector& detector() const { return detector_; }

  /// Whether samples are tested: an experiment is running, or there is no experiment topic.
  bool active() const { return active_; }

 private:
  struct Marker {
    double stamp;
    bool active;
  };

  /// Samples that are taken together as one of the model's.
  struct Group {
    double instant = 0, y = 0;  ///< of the first of them
    double input = 0;           ///< sum
    int count = 0;
  };

  void setSampleTime(const Estimate& estimate);
  void take(double instant, double u, double y, std::vector<StampedFaultWindow>* found);
  void test(double instant, double u, double y, std::vector<StampedFaultWindow>* found);
  void bridge(const Recording& piece, double until, std::vector<StampedFaultWindow>* found);
  double heldInput(const Recording& piece, double instant) const;
  void beginWindows();

  FaultDetectionOptions options_;
  FaultDetector detector_;
  int thinning_ = 1;
  double sample_time_ = 0;  ///< [s] of the signals' grid
  Group group_;             ///< not yet complete
  ResamplingOptions resampling_;
  int piece_samples_ = 0;
  bool active_;
  std::deque<Marker> markers_;
  std::optional<double> newest_;  ///< [s] sampling instant of the newest sample
  double newest_input_ = 0;       ///< input of that sample
  StampedSignal last_input_;      ///< of the piece before; it may reach beyond the last output
  std::deque<double> instants_;   ///< [s] sampling instants of the samples from instants_first_ on
  long instants_first_ = 0;       ///< index of the first of them in the experiment
};

}  // namespace uncertainty_identification
