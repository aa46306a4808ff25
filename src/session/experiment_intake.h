#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <variant>

#include "session/work_queue.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/loaded_data.h"

namespace uncertainty_identification {

/// What a recorder gives at the end of an experiment: its raw signals, the experiment itself when
/// it came complete in one message, or the reason why it cannot be used.
using FinishedExperiment = std::variant<Recording, Experiment, RejectedExperiment>;

/// Resamples finished experiments and delivers them to the worker, in order, in a thread of its
/// own. The recorder therefore never waits for resampling, and an experiment is taken in while an
/// identification runs.
///
/// All functions may be called from any thread, but see `deliver` below.
class ExperimentIntake {
 public:
  /// Both callbacks are called in the intake's thread. `deliver` gets one finished experiment at a
  /// time: either an experiment or the reason for its rejection. The intake's mutex is held during
  /// the call, so `deliver` must not call clear(), configure() or setFirstSampleTime(): that would
  /// deadlock. `processed` is called without the mutex each time waiting() has decreased, also when
  /// the experiment was dropped by clear().
  ExperimentIntake(const Configuration& configuration, std::function<void(LoadedData)> deliver,
                   std::function<void()> processed);

  /// Blocks until every waiting experiment has been resampled and delivered.
  ~ExperimentIntake();

  ExperimentIntake(const ExperimentIntake&) = delete;
  ExperimentIntake& operator=(const ExperimentIntake&) = delete;

  /// Appends a finished experiment to the queue and returns at once.
  void add(FinishedExperiment finished);

  /// When this returns, no experiment added before will be delivered any more, and the sample time
  /// of the first experiment is forgotten. The dropped experiments count in waiting() until the
  /// thread has passed them.
  void clear();

  /// Applies to experiments that are resampled later. Those already delivered keep their samples.
  void configure(const Configuration& configuration);

  /// Sets the sample time [s] of the first experiment when that one was not delivered by this
  /// intake but read from the store.
  void setFirstSampleTime(double sample_time);

  /// The number of experiments that were added and that the thread has not yet delivered or, after
  /// clear(), passed over.
  int waiting() const { return waiting_; }

 private:
  struct Item {
    unsigned generation;  // value of generation_ when the experiment was added
    FinishedExperiment finished;
  };

  void run();
  LoadedData load(FinishedExperiment finished);

  const std::function<void(LoadedData)> deliver_;
  const std::function<void()> processed_;
  WorkQueue<Item> queue_;
  std::atomic<unsigned> generation_{0};  // incremented by clear(): items of older ones are dropped
  std::atomic<int> waiting_{0};

  std::mutex mutex_;               // guards the members below; held while one item is processed
  double configured_sample_time_;  // [s] as in Configuration: 0 means automatic
  ResamplingOptions resampling_;
  // [s] of the first experiment since the start or clear(); none before it. With an automatic
  // sample time, later recordings of about the same rate get exactly this one (addResampled).
  std::optional<double> first_sample_time_;

  std::thread thread_;  // declared last: it starts when all other members exist
};

}  // namespace uncertainty_identification
