#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "ros/experiment_store.h"
#include "ros/retry_queue.h"

namespace uncertainty_identification {

/// How the store is doing, for ~status and diagnostics.
struct StoreStatus {
  int stored = 0;        ///< experiments on the disk, rejected ones left out
  std::string last_id;   ///< of the newest one written
  int pending = 0;       ///< what waits to be written
  int lost = 0;          ///< what was given up: more waited than there is room for
  bool failing = false;  ///< the disk refuses; it is tried again
  std::string message;   ///< why, and what to do; empty: all is well
};

/// Writes what a node learns into its store, in a thread of its own: nobody waits for the disk, and
/// what it refuses waits in memory until it does not. May be used from any thread.
class StoreWriter {
 public:
  /// Opens the store in `directory`. Loads as many experiments as `limits` say; as many files, and
  /// at least a thousand, find room while the disk refuses. `changed` is
  /// called when status() changed, from the writer's thread. Throws ConfigurationError as
  /// ExperimentStore does.
  StoreWriter(const std::string& directory, const LimitOptions& limits,
              std::function<void()> changed);

  /// What the store held when it was opened. To be called once, before anything is written.
  StoredState load();

  void keep(const KeptExperiment& experiment);
  void keep(const StoredResult& result);  ///< in place of one that still waits
  void keep(const StoredConfiguration& configuration);
  void reject(std::uint64_t number, const RejectedExperiment& rejected);
  void reject(const RejectedExperiment& rejected);
  void reset();

  StoreStatus status() const;

 private:
  void change(const std::function<void(StoreStatus&)>& change);

  const LimitOptions limits_;
  ExperimentStore store_;  // of the queue's thread, once that has something to do
  mutable std::mutex mutex_;
  StoreStatus status_;  // guarded by mutex_: stored and last_id
  RetryQueue queue_;    // last, so that it finds all of the above
};

}  // namespace uncertainty_identification
