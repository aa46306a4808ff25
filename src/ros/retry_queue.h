#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace uncertainty_identification {

/// Carries out tasks in order, in a thread of its own, each again and again until it succeeds: what
/// is to be written to a disk that may be full, slow or gone for a while. Knows no ROS.
class RetryQueue {
 public:
  /// Throws FileError where it is to be tried again; another exception gives it up.
  using Task = std::function<void()>;

  struct Status {
    int waiting = 0;       ///< tasks not done yet
    int lost = 0;          ///< tasks given up: too many waited, or they cannot be done
    bool failing = false;  ///< the oldest one is being tried again
    std::string message;   ///< why the last one failed; empty: none did
  };

  /// `changed` is called from the queue's thread after each attempt. Of more than `most` tasks that
  /// wait the oldest are given up.
  RetryQueue(std::size_t most, std::chrono::milliseconds interval, std::function<void()> changed);

  /// Tries once more what waits, up to the first task that fails.
  ~RetryQueue();

  RetryQueue(const RetryQueue&) = delete;
  RetryQueue& operator=(const RetryQueue&) = delete;

  /// A task with a key takes the place of one of the same key that waits.
  void push(Task task, const std::string& key = "");

  Status status() const;

 private:
  struct Entry {
    Task task;
    std::string key;
  };

  void run();
  void attempt(std::unique_lock<std::mutex>& lock);

  const std::size_t most_;
  const std::chrono::milliseconds interval_;
  const std::function<void()> changed_;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable wake_;
  std::deque<Entry> waiting_;
  bool busy_ = false;  // a task has been taken out and runs
  Status status_;
  bool stopping_ = false;
  std::thread thread_;  // last, so that it finds all of the above
};

}  // namespace uncertainty_identification
