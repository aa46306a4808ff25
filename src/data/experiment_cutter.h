#pragma once

#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "data/stamp_gate.h"
#include "data/stamped_buffer.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/recording.h"
#include "uncertainty_identification/data/rejected_experiment.h"

namespace uncertainty_identification {

/// Cuts streams of stamped samples into experiments. The live recorder and the bag reader both use
/// it, so that the same stamps give the same experiments at any replay rate and offline.
///
/// An experiment holds the samples with start <= stamp < end. Its cuts come from
/// - mode topic and service: begin() and finish(), or markers; the stamp of the call counts, not
/// its arrival;
/// - mode duration: windows of `duration` seconds, one after the other, from the first stamp at
/// which both signals are
///   present; windows without an output are skipped;
/// - mode gap: a silence of both signals longer than `gap` seconds.
///
/// Topics may arrive in any order among each other, each in order of its stamps. An experiment is
/// therefore released only when input and output have both shown a stamp at or past its end (or by
/// releaseClosed() or flush()), and samples beyond the end are kept for the next one. The newest
/// input and the newest value of each covariate before an experiment become part of it, because
/// they still act when it starts.
///
/// Three samples in a row whose stamps are smaller than the ones before on the same signal mean
/// that the clock went back (a looped bag, a reset simulation): the running experiment is rejected,
/// and recording goes on with the new clock. One or two are strays, which are left out and counted
/// (StampGate). Closed experiments still take samples of the old clock, until input and output have
/// both shown the new one; a running one can still be ended by a marker of the old clock, until a
/// marker has shown the new one or that is halfway back. Covariates are not waited for. Memory is
/// bounded by LimitOptions::max_samples: an experiment that reaches them (in any signal) is closed,
/// with a note, and no more than twice as many samples wait for a late marker or for the other
/// signal.
class ExperimentCutter {
 public:
  ExperimentCutter(const ExperimentOptions& options, const LimitOptions& limits);

  void addInput(double stamp, double value, const Arrival& arrival = {});
  void addOutput(double stamp, double value, const Arrival& arrival = {});
  void addCovariate(const std::string& name, double stamp, double value);

  /// Mode topic: a rise of `active` begins an experiment, a fall ends it; a repeated marker changes
  /// nothing, unless it is active and names another experiment. Ignored in other modes. An empty
  /// id: "experiment_000" and so on, by count.
  void addMarker(double stamp, bool active, const std::string& id = "");

  /// Modes topic and service: begins an experiment at `stamp` [s]. False if one is running, or in
  /// other modes.
  bool begin(double stamp, const std::string& id = "");

  /// Ends the running experiment at `stamp` [s]. False if none is running.
  bool finish(double stamp);

  /// Drops the running experiment. False if none is running.
  bool discard();

  /// Whether an experiment is running: begun, or filling, and not yet ended.
  bool running() const;

  /// Whether an experiment (also one of the old clock) has ended but waits for a signal to show a
  /// stamp past its end.
  bool waiting() const;

  /// Releases what has ended without waiting any longer for samples (a node does so when the topics
  /// are silent).
  void releaseClosed();

  /// To be called at the end of the data: releases everything, also the running experiment (with a
  /// note in modes topic and service, with a shorter window in mode duration). Use a new cutter for
  /// other data.
  void flush();

  /// Returns the experiments that were finished since the last call, in order.
  std::vector<Recording> takeFinished();

  /// Returns the experiments that were rejected since the last call, in order.
  std::vector<RejectedExperiment> takeRejected();

  /// Number of samples with the same stamp as the previous one (see Duplicates).
  long duplicates() const { return duplicates_; }

  /// How often the clock went back.
  long clockResets() const { return clock_resets_; }

  /// Number of samples left out because their stamp was not finite, or belonged to the old clock
  /// after the clock went back.
  long dropped() const { return dropped_; }

 private:
  static constexpr double kNever = StampedBuffer::kNever;

  /// A sample on its way to a buffer.
  struct Received {
    double stamp, value;
    Arrival arrival;
  };
  using Gate = StampGate<Received>;
  static constexpr double kEndless = std::numeric_limits<double>::infinity();

  /// A span of stamps that becomes one experiment.
  struct Window {
    std::string id;
    double start = 0;
    double end = kEndless;  ///< kEndless: not known yet
    std::string note;
  };

  bool cutsByCall() const;
  bool ended(const Window& window) const { return window.end <= now_; }

  void takeInput(const std::vector<Received>& samples);
  void takeOutput(const std::vector<Received>& samples);
  void takeCovariate(const std::string& name, const std::vector<Received>& samples);
  void confirmClock(double stamp);
  void takeHeldBack();
  void addSample(const std::string& signal, StampedBuffer& buffer, double stamp, double value,
                 Duplicates keep, const Arrival& arrival = {});
  bool acceptStamp(const std::string& signal, double newest, double stamp);
  bool ofOldClock(double newest, double stamp) const;
  void resetClock(const std::string& signal, double from, double to);
  void rejectRunning();
  void releaseOldClock();
  bool oldClockAwaited() const;

  void advance();
  void openWindow(double start, double end, const std::string& id = "");
  void openDurationWindow();
  void followActivity(double known_until);
  void closeFull();
  void releaseFront();
  void boundMemory();
  bool crowded() const;

  ExperimentOptions options_;
  std::size_t max_samples_;
  StampedBuffer input_, output_;
  std::map<std::string, StampedBuffer> covariates_;
  Gate input_gate_, output_gate_;  ///< before the buffers; they outlive a reset of the clock
  std::map<std::string, Gate> covariate_gates_;
  std::deque<Window> windows_;  ///< in order; only the last one may be running
  std::vector<Recording> finished_;
  std::vector<RejectedExperiment> rejected_;
  bool marker_active_ = false;
  std::string marker_id_;        ///< as the last marker that began an experiment gave it
  double newest_call_ = kNever;  ///< [s] stamp of the last marker or call
  double now_ = kNever;          ///< [s] newest stamp of all
  double old_clock_ = kEndless;  ///< [s] after a reset: later stamps are the old clock's, until the
                                 ///< new one gets there
  std::unique_ptr<ExperimentCutter> before_;  ///< experiments of the old clock, while they wait for
                                              ///< samples or their end; null: none
  std::string torn_;                          ///< why the running one is rejected if none comes
  double first_window_ = kNever;              ///< [s] mode duration: start of the first window
  double released_until_ = kNever;            ///< [s] end of the last window released
  double activity_ = kNever;  ///< [s] mode gap: newest stamp before which no sample is missing
  long begun_ = 0, duplicates_ = 0, clock_resets_ = 0, dropped_ = 0;
};

}  // namespace uncertainty_identification
