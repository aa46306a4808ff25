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

#include "session/experiment_intake.h"
#include "session/experiment_set.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// A usable estimate and what it was made from.
struct WorkerResult {
  std::shared_ptr<const Estimate> estimate;
  bool preliminary = false;  ///< a quick update of the result before (Identifier::reidentify)
  ExperimentWindow window;
  /// As it was asked for. In the estimate's copy the automatic choices are replaced by what was
  /// chosen.
  Configuration configuration;
  std::vector<KeptExperiment> kept{};  ///< the experiments now, with those it was made from
  int rejected = 0;                    ///< number of experiments that are not used
};

/// What a worker is doing, and how its last identification ended.
struct WorkerStatus {
  bool busy = false;    ///< an identification runs or is still to come
  bool failed = false;  ///< the last identification or experiment was not usable
  Termination termination = Termination::not_run;
  std::string message = "no experiment has finished yet";
  int stored = 0;           ///< number of experiments in the set
  std::string last_id;      ///< id of the newest experiment in the set
  ExperimentTiming timing;  ///< how the samples of the newest experiment arrived
  int queue = 0;            ///< experiments that finished after the last identification began
  double seconds = 0;       ///< [s] wall time of the last identification
  int iterations = 0;       ///< number of iterations of the last identification
  Trust trust;              ///< in the last result
};

/// A copy of the experiments at one moment.
struct WorkerSnapshot {
  std::vector<Experiment> experiments;
  std::uint64_t version = 0;  ///< number that changes with every change of the experiments
  unsigned generation = 0;    ///< number that changes with every reset() and adopt()
};

/// Keeps the experiments of a node and identifies from them in a thread of its own, each time
/// experiments have finished. All experiments that finished during an identification are taken into
/// the next one together.
///
/// When there is a result, the next one starts from it (Identifier::reidentify), which is quick but
/// stays near the same local optimum. configuration.full_identification states when the experiments
/// are identified from scratch as well, as a tool would offline; of the two results the one with
/// the higher log-likelihood is kept.
class IdentificationWorker {
 public:
  /// Callbacks, called from any thread. They must not call the worker, because its mutex may be
  /// held; only `changed` may call status().
  struct Listener {
    std::function<void(const WorkerResult&)> result;  ///< there is a new usable result
    std::function<void(const KeptExperiment&)> kept;  ///< an experiment was added to the set
    std::function<void(const RejectedExperiment&)> rejected;  ///< a recording gave no experiment
    std::function<void()> changed;                            ///< status() has changed
    std::function<void(const std::string&)> warning;          ///< a message for the user
    /// An identification begins, in words; it ends when the returned object is destroyed. Called
    /// without the mutex.
    std::function<std::shared_ptr<void>(const std::string&)> begins = [](const std::string&) {
      return nullptr;
    };
    /// How far the running identification is. Called without the mutex, many times a second.
    std::function<void(const Progress&)> progress = [](const Progress&) {};
  };

  /// Throws ConfigurationError when the configuration is not valid.
  IdentificationWorker(const Configuration& configuration, Listener listener);

  /// Cancels the running identification. Experiments that were added are still taken in and
  /// reported to the listener, so that none is lost; blocks until that is done.
  ~IdentificationWorker();

  IdentificationWorker(const IdentificationWorker&) = delete;
  IdentificationWorker& operator=(const IdentificationWorker&) = delete;

  /// Adds a finished experiment and returns at once.
  void add(FinishedExperiment experiment);

  /// Continues from experiments and a result of an earlier run; to be called before add().
  /// Experiments added later get numbers above `last_number`. If there is no result, or it was
  /// made from other experiments than these, an identification is started.
  void restore(std::vector<KeptExperiment> kept, std::vector<RejectedExperiment> rejected,
               std::uint64_t last_number, const std::optional<WorkerResult>& result);

  /// Removes an experiment and identifies without it. Returns the experiment's number, or nothing
  /// when there is no experiment of this id.
  std::optional<std::uint64_t> reject(const std::string& id, const std::string& reason);

  /// Call this before add() for an experiment that a user asks to add. Returns whether the
  /// experiment will be accepted (ExperimentSet::readmit).
  bool readmit(const Experiment& experiment);

  /// Forgets all experiments and the result. The running identification is cancelled and its
  /// result is not published.
  void reset();

  WorkerSnapshot snapshot() const;

  /// Continues with another configuration. `estimate` is what that configuration gave from the
  /// snapshot's experiments; null when nothing was identified. The running identification is
  /// cancelled and its result is not published.
  void adopt(const Configuration& configuration, std::shared_ptr<const Estimate> estimate,
             const WorkerSnapshot& snapshot);

  WorkerStatus status() const;
  std::vector<ExperimentDigest> experiments() const;

 private:
  /// One round of the thread: a quick update, a full identification, or both in this order.
  struct Work {
    std::shared_ptr<const Identifier> identifier;
    WorkerSnapshot snapshot;
    std::shared_ptr<const Estimate> last;  // the result before; null: there is none
    bool quick = false;                    // update the result before
    bool full = false;                     // identify from scratch
    bool interruptible = false;            // a new experiment cancels the full identification
  };

  void receive(LoadedData data);
  void run();
  bool takeWork(Work& work);
  bool fullIsDue() const;
  bool fullFollows() const;
  void carryOut(Work& work);
  bool identify(bool preliminary, Work& work);
  Estimate estimate(bool preliminary, const Work& work);
  void succeed(Estimate estimate, bool preliminary, Work& work);
  void fail(const std::string& message, Termination termination, const Work& work);
  bool isCurrent(const WorkerSnapshot& snapshot, bool interruptible) const;
  WorkerSnapshot snapshotLocked() const;
  void setStatusFrom(const Estimate& estimate);
  std::vector<ExperimentDigest> digestsLocked() const;
  WorkerResult resultLocked(bool preliminary, const std::vector<Experiment>& experiments,
                            const Configuration& configuration) const;
  void change(const std::function<void()>& change);

  const Listener listener_;
  std::atomic<bool> stopping_{false};
  std::atomic<unsigned> generation_{0};    // see WorkerSnapshot
  std::atomic<std::uint64_t> version_{0};  // see WorkerSnapshot

  mutable std::mutex mutex_;  // guards the members down to unusable_
  std::condition_variable wake_;
  FullIdentificationOptions full_options_;
  std::shared_ptr<const Identifier> identifier_;
  ExperimentSet set_;
  WorkerStatus status_;
  int waiting_ = 0;                             // experiments added since work was taken last
  std::uint64_t version_taken_ = 0;             // the version that work was taken of last
  std::uint64_t version_fully_identified_ = 0;  // the version last identified from scratch
  std::shared_ptr<const Estimate> last_;        // the last result
  std::vector<RejectedExperiment> unusable_;    // rejected by the checks of the last identification

  ExperimentIntake intake_;  // calls receive(), so it follows all that this needs
  std::thread thread_;       // declared last: it starts when all other members exist
};

}  // namespace uncertainty_identification
