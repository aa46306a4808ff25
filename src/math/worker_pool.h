#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace uncertainty_identification {

class Interruption;

/// Threads that share the iterations of a loop. Which thread runs which iteration is not
/// determined. Iterations must therefore write to separate places, and sums must be formed
/// afterwards in a fixed order; then the number of threads does not change a result.
class WorkerPool {
 public:
  /// `threads` includes the calling thread and is at least 1.
  explicit WorkerPool(int threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Calls task(i) for i = 0..count-1 and returns when all calls have finished. Rethrows an
  /// exception that a call has thrown, and CancelledError when an Interruption of the calling
  /// thread asks for the end.
  void forEach(int count, const std::function<void(int)>& task);

 private:
  void work();
  void takeTurns();
  void waitForOthers();

  std::vector<std::thread> workers_;
  std::mutex mutex_;
  std::condition_variable start_, done_;
  const std::function<void(int)>* task_ = nullptr;
  int count_ = 0, busy_ = 0;
  unsigned long round_ = 0;
  bool stop_ = false;
  std::atomic<int> next_{0};
  std::exception_ptr failure_;
  Interruption* interruption_ = nullptr;  // applies to the calling thread
};

}  // namespace uncertainty_identification
