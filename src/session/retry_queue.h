#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace uncertainty_identification {

/// Runs tasks one after the other in a thread of its own and repeats each until it succeeds. It is
/// meant for writing to a disk that may be full, slow or absent for a while: push() never waits for
/// a task.
class RetryQueue {
 public:
  /// A task that throws FileError is tried again after the retry interval; later tasks wait until
  /// it succeeds. A task that throws any other exception is dropped and counted as lost.
  using Task = std::function<void()>;

  struct Status {
    int waiting = 0;       ///< tasks that are not done yet, including the one that runs
    int lost = 0;          ///< tasks that were dropped, because too many waited or they threw
    bool failing = false;  ///< the oldest task failed and is being retried
    std::string message;   ///< why the last attempt failed; empty when it succeeded
  };

  /// Keeps at most `capacity` waiting tasks (at least one) and drops the oldest when more are
  /// pushed. `interval` is the time between two attempts. `attempted` is called in the queue's
  /// thread after each attempt.
  RetryQueue(std::size_t capacity, std::chrono::milliseconds interval,
             std::function<void()> attempted);

  /// Runs the waiting tasks once more, in order, and stops at the first one that fails. Blocks
  /// until that is done.
  ~RetryQueue();

  RetryQueue(const RetryQueue&) = delete;
  RetryQueue& operator=(const RetryQueue&) = delete;

  /// Appends a task; `what` names it. With a key that is not empty it replaces a waiting task of
  /// the same key.
  void push(Task task, const std::string& key = "", const std::string& what = "");

  /// Does what the destructor does, and returns the names of the tasks that are not done. Nothing
  /// may be pushed afterwards.
  std::vector<std::string> stop();

  Status status() const;

 private:
  struct Entry {
    Task task;
    std::string key, what;
  };

  void run();
  void attempt(std::unique_lock<std::mutex>& lock);

  const std::size_t capacity_;
  const std::chrono::milliseconds interval_;
  const std::function<void()> attempted_;
  mutable std::mutex mutex_;  // guards all members below
  std::condition_variable wake_;
  std::deque<Entry> waiting_;
  bool busy_ = false;  // a task was removed from waiting_ and is running
  Status status_;
  bool stopping_ = false;
  std::thread thread_;  // declared last: it starts when all other members exist
};

}  // namespace uncertainty_identification
