#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "uncertainty_identification/identifier.h"
#include "uncertainty_identification/ros/experiment_set.h"
#include "uncertainty_identification/ros/work_queue.h"

namespace uncertainty_identification {

/// What a recorder hands on: the raw material of an experiment, a complete one, or the reason why
/// there is none.
using FinishedExperiment = std::variant<Recording, Experiment, RejectedExperiment>;

/// A usable estimate, and what it was made from.
struct WorkerResult {
  std::shared_ptr<const Estimate> estimate;
  bool preliminary = false;  ///< started from the one before; the full identification follows
  TimeWindow window;
};

/// What a worker is doing, and how its last identification went.
struct WorkerStatus {
  bool busy = false;    ///< experiments wait or are identified from
  bool failed = false;  ///< the last identification gave no usable result
  Termination termination = Termination::not_run;
  std::string message = "no experiment has finished yet";
  int stored = 0;       ///< experiments kept
  std::string last_id;  ///< of the newest one
  int queue = 0;        ///< experiments that wait
  double seconds = 0;   ///< [s] wall time of the last identification
  int iterations = 0;   ///< that it took
};

/// Identifies in a thread of its own each time experiments finish, taking all that wait at once.
/// When there is a result already, it is brought up to date first (Identifier::reidentify), which
/// is quick; once no more experiments wait, the same experiments are identified in full, so that
/// the result is what identifying them offline gives. New experiments interrupt that, a quick
/// update having been published. Knows no ROS.
class IdentificationWorker {
 public:
  struct Listener {
    std::function<void(const WorkerResult&)> result;  ///< a usable result; must not call the worker
    std::function<void()> changed;                    ///< status() changed; called from any thread
    std::function<void(const std::string&)> warning;  ///< what was found about an experiment
  };

  /// Throws ConfigurationError when the configuration is not valid.
  IdentificationWorker(const Configuration& configuration, Listener listener);

  /// Cancels what runs and waits for its end.
  ~IdentificationWorker();

  IdentificationWorker(const IdentificationWorker&) = delete;
  IdentificationWorker& operator=(const IdentificationWorker&) = delete;

  void add(FinishedExperiment experiment);

  /// Forgets all experiments and the result; what is running is cancelled and not published.
  void reset();

  WorkerStatus status() const;
  std::vector<ExperimentDigest> experiments() const;

 private:
  struct Item {
    unsigned resets;  // as many as there had been
    FinishedExperiment experiment;
  };

  void run();
  void absorb(std::vector<Item> items);
  LoadedData load(std::vector<Item> items, unsigned resets) const;
  void update();
  void identify(bool preliminary);
  Estimate estimate(bool preliminary);
  void succeed(Estimate estimate, bool preliminary);
  void fail(const std::string& message, Termination termination);
  bool wanted(bool interruptible) const;
  template <typename Change>
  void change(const Change& change);

  const Configuration configuration_;
  const Identifier identifier_;
  const Listener listener_;
  WorkQueue<Item> queue_;
  std::atomic<bool> stopping_{false};
  std::atomic<unsigned> resets_{0};

  std::shared_ptr<const Estimate> last_;  // of the worker's thread alone

  // Guards what follows. The set and resets_seen_ change in the worker's thread only, which reads
  // them without it.
  mutable std::mutex mutex_;
  unsigned resets_seen_ = 0;
  ExperimentSet set_;
  WorkerStatus status_;
  std::vector<RejectedExperiment> unfit_;  // found by the checks of the last identification

  std::thread thread_;  // last, so that it finds all of the above
};

}  // namespace uncertainty_identification
