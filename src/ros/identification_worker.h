#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "ros/experiment_intake.h"
#include "ros/experiment_set.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// A usable estimate, and what it was made from.
struct WorkerResult {
  std::shared_ptr<const Estimate> estimate;
  bool preliminary = false;  ///< started from the one before
  ExperimentWindow window;
  Configuration configuration;  ///< asked for; the estimate has it with its choices made
};

/// What a worker is doing, and how its last identification went.
struct WorkerStatus {
  bool busy = false;    ///< experiments wait or are identified from
  bool failed = false;  ///< the last identification gave no usable result
  Termination termination = Termination::not_run;
  std::string message = "no experiment has finished yet";
  int stored = 0;           ///< experiments kept
  std::string last_id;      ///< of the newest one
  ExperimentTiming timing;  ///< likewise
  int queue = 0;            ///< experiments that wait
  double seconds = 0;       ///< [s] wall time of the last identification
  int iterations = 0;       ///< that it took
};

/// The experiments at one moment.
struct WorkerSnapshot {
  std::vector<Experiment> experiments;
  std::uint64_t version = 0;  ///< changes with the experiments
  unsigned resets = 0;  ///< changes when they are no longer to be identified from as they were
};

/// Identifies in a thread of its own each time experiments finish, taking all that wait at once.
/// When there is a result already, it is brought up to date (Identifier::reidentify), which is
/// quick. That follows a local optimum: configuration.full_identification says when the same
/// experiments are identified in full, as they would be offline, and the better result stays.
/// Knows no ROS.
class IdentificationWorker {
 public:
  /// What the worker tells, from any thread. None may call the worker, but `changed` its status().
  struct Listener {
    std::function<void(const WorkerResult&)> result;          ///< a usable one
    std::function<void(const KeptExperiment&)> kept;          ///< an experiment came in
    std::function<void(const RejectedExperiment&)> rejected;  ///< or could not be used
    std::function<void()> changed;                            ///< status() changed
    std::function<void(const std::string&)> warning;  ///< what was found about an experiment
  };

  /// Throws ConfigurationError when the configuration is not valid.
  IdentificationWorker(const Configuration& configuration, Listener listener);

  /// Takes in what has finished, and cancels what runs.
  ~IdentificationWorker();

  IdentificationWorker(const IdentificationWorker&) = delete;
  IdentificationWorker& operator=(const IdentificationWorker&) = delete;

  void add(FinishedExperiment experiment);

  /// Takes up what was kept before, numbers up to `last` being taken; to be called first. Without a
  /// result, or where that does not rest on all of these experiments, they are identified from.
  void restore(std::vector<KeptExperiment> kept, std::vector<RejectedExperiment> rejected,
               std::uint64_t last, const std::optional<WorkerResult>& result);

  /// Takes an experiment out and identifies without it; its number, or nothing where there is no
  /// such one.
  std::optional<std::uint64_t> reject(const std::string& id, const std::string& reason);

  /// Whether an experiment that is asked for, and added next, will count (ExperimentSet::readmit).
  bool readmit(const Experiment& experiment);

  /// Forgets all experiments and the result; what is running is cancelled and not published.
  void reset();

  WorkerSnapshot snapshot() const;

  /// Goes on with another configuration, and with what it gave of a snapshot's experiments (null:
  /// nothing); what is running is cancelled and not published.
  void adopt(const Configuration& configuration, std::shared_ptr<const Estimate> estimate,
             const WorkerSnapshot& snapshot);

  WorkerStatus status() const;
  std::vector<ExperimentDigest> experiments() const;

 private:
  struct Work {
    std::shared_ptr<const Identifier> identifier;
    WorkerSnapshot at;
    std::shared_ptr<const Estimate> last;  // to start from; null: there is none
    bool quick = false;                    // to be brought up to date
    bool full = false;                     // a full identification is due
    bool interruptible = false;            // by experiments that come while that runs
  };

  void receive(LoadedData data);
  void run();
  bool takeWork(Work& work);
  bool fullIsDue() const;
  bool fullFollows() const;
  void update(Work& work);
  bool identify(bool preliminary, Work& work);
  Estimate estimate(bool preliminary, const Work& work);
  void succeed(Estimate estimate, bool preliminary, Work& work);
  void fail(const std::string& message, Termination termination, const Work& work);
  bool wanted(const WorkerSnapshot& at, bool interruptible) const;
  WorkerSnapshot snapshotLocked() const;
  void change(const std::function<void()>& change);

  const Listener listener_;
  std::atomic<bool> stopping_{false};
  std::atomic<unsigned> resets_{0};
  std::atomic<std::uint64_t> version_{0};  // of the set

  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable wake_;
  FullIdentificationOptions full_;
  std::shared_ptr<const Identifier> identifier_;
  ExperimentSet set_;
  WorkerStatus status_;
  int waiting_ = 0;                        // experiments that came since work was taken
  std::uint64_t seen_ = 0;                 // the version that work was taken of
  std::uint64_t identified_in_full_ = 0;   // the version that was
  std::shared_ptr<const Estimate> last_;   // the last result
  std::vector<RejectedExperiment> unfit_;  // found by the checks of the last identification

  ExperimentIntake intake_;  // calls receive()
  std::thread thread_;       // last, so that it finds all of the above
};

}  // namespace uncertainty_identification
