#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "session/experiment_store.h"
#include "session/retry_queue.h"

namespace uncertainty_identification {

/// The state of the store, for ~status and diagnostics.
struct StoreStatus {
  int stored = 0;        ///< experiments on the disk, without the rejected ones
  std::string last_id;   ///< id of the newest experiment on the disk
  int pending = 0;       ///< files that wait to be written
  int lost = 0;          ///< files that were given up, because too many waited
  bool failing = false;  ///< writing failed and is being retried
  std::string message;   ///< why it failed; empty when all is well
};

/// Writes a node's experiments and results into its store in a thread of its own. Callers never
/// wait for the disk. What cannot be written stays in memory and is retried every second. All
/// functions but load() may be called from any thread.
class StoreWriter {
 public:
  struct Listener {
    /// The status has changed. Called in the writer's thread, which holds no mutex.
    std::function<void(const StoreStatus&)> changed;
    /// Called by the destructor with the names of the files that were not written, if there are
    /// any.
    std::function<void(const std::vector<std::string>&)> unwritten;
  };

  /// Opens the store in `directory`. Up to max(1000, limits.max_experiments) files wait in memory
  /// while the disk refuses to write. Throws ConfigurationError like ExperimentStore.
  StoreWriter(const std::string& directory, ExperimentFiles files, const LimitOptions& limits,
              Listener listener);

  /// Tries once more to write what waits, and tells the listener what could not be written.
  ~StoreWriter();

  StoreWriter(const StoreWriter&) = delete;
  StoreWriter& operator=(const StoreWriter&) = delete;

  /// Reads what the store held when it was opened. To be called once, before any other function.
  StoredState load();

  void keep(const KeptExperiment& experiment);
  void keep(const StoredResult& result);  ///< replaces an older result that still waits
  void keep(const StoredConfiguration& configuration);  ///< replaces likewise
  void reject(std::uint64_t number, const RejectedExperiment& rejected);
  void reject(const RejectedExperiment& rejected);
  void reset();

  StoreStatus status() const;

 private:
  void change(const std::function<void(StoreStatus&)>& change);

  const Listener listener_;
  const LimitOptions limits_;
  ExperimentStore store_;     // after load() used by the queue's thread only
  mutable std::mutex mutex_;  // guards status_
  StoreStatus status_;        // only `stored` and `last_id`; status() fills in the rest
  RetryQueue queue_;          // declared last: its thread uses all other members
};

}  // namespace uncertainty_identification
