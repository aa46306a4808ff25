#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace uncertainty_identification {

/// Threads that share a loop. Which thread does which turn is left open, so turns must write to
/// places of their own and whoever adds up does so in a fixed order: then the number of threads
/// never changes a result.
class WorkerPool {
 public:
  /// `threads` at least 1, the caller's included.
  explicit WorkerPool(int threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Calls task(i) for i = 0..count-1 and returns when all are done; an exception of a task is
  /// thrown here.
  void forEach(int count, const std::function<void(int)>& task);

 private:
  void work();
  void takeTurns();

  std::vector<std::thread> workers_;
  std::mutex mutex_;
  std::condition_variable start_, done_;
  const std::function<void(int)>* task_ = nullptr;
  int count_ = 0, busy_ = 0;
  unsigned long round_ = 0;
  bool stop_ = false;
  std::atomic<int> next_{0};
  std::exception_ptr failure_;
};

}  // namespace uncertainty_identification
