#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "detection/fault_detector.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/recording.h"

namespace uncertainty_identification {

/// Everything that determines a fault detector on live signals.
struct FaultDetectionConfiguration {
  FaultDetectionOptions detection;
  SignalOptions input{"", "actuator/command", "auto"};
  SignalOptions output{"", "sensor/measurement", "auto"};
  std::string experiment_topic;  ///< std_msgs/Bool or ExperimentMarker that begins and ends
                                 ///< experiments; empty = one experiment without an end
  ResamplingOptions resampling;

  /// Throws ConfigurationError naming key, value and allowed range.
  void validate() const;
};

/// A decision, and when its window was measured.
struct StampedFaultWindow {
  FaultWindow window;
  double start = 0, end = 0;  ///< [s] instants of the window's first and last sample
};

/// A fault detector on stamped signals: they come in pieces, one after the other, each is put on
/// the grid as resample() does, and what lies between two pieces counts as not measured.
class LiveFaultDetector {
 public:
  /// Throws as FaultDetector does.
  LiveFaultDetector(const Estimate& estimate, const FaultDetectionConfiguration& configuration);

  /// The first experiment begins with the first sample, or where there is a topic for it, with the
  /// first marker; an active marker begins an experiment at `stamp` [s], the other ends it. Markers
  /// act on samples that come after them.
  void addMarker(double stamp, bool active);

  /// Takes the next piece. Throws DataError as resample() does; the piece is then left out.
  std::vector<StampedFaultWindow> add(const Recording& piece);

  /// The signals were interrupted: the next piece begins a new experiment.
  void interrupt();

  /// [s] how long a piece should be: a fifth of a window, not less than 10 samples.
  double pieceDuration() const { return piece_samples_ * detector_.sampleTime(); }

  const FaultDetector& detector() const { return detector_; }

  /// Whether samples are looked at: no experiment topic, or an experiment is running.
  bool active() const { return active_; }

 private:
  struct Marker {
    double stamp;
    bool active;
  };

  void take(double instant, double u, double y, std::vector<StampedFaultWindow>* found);
  void bridge(const Recording& piece, double until, std::vector<StampedFaultWindow>* found);
  double heldInput(const Recording& piece, double instant) const;

  FaultDetector detector_;
  ResamplingOptions resampling_;
  int piece_samples_;
  bool active_;
  std::deque<Marker> markers_;
  std::optional<double> newest_;  ///< [s] instant of the newest sample
  double newest_input_ = 0;       ///< u there
  StampedSignal last_input_;      ///< of the piece before: samples at its end may lack an output
  std::deque<double> instants_;   ///< [s] of the samples from instants_first_ on
  long instants_first_ = 0;       ///< counted since the experiment began
};

}  // namespace uncertainty_identification
