#include "math/worker_pool.h"

#include <chrono>

#include "math/interruption.h"

namespace uncertainty_identification {

WorkerPool::WorkerPool(int threads) {
  for (int i = 1; i < threads; ++i) workers_.emplace_back([this] { work(); });
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  start_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void WorkerPool::forEach(int count, const std::function<void(int)>& task) {
  if (workers_.empty() || count < 2) {
    for (int i = 0; i < count; ++i) {
      checkpoint();
      task(i);
    }
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    task_ = &task;
    count_ = count;
    next_ = 0;
    busy_ = static_cast<int>(workers_.size());
    failure_ = nullptr;
    interruption_ = Interruption::current();
    ++round_;
  }
  start_.notify_all();
  takeTurns();
  waitForOthers();
  if (failure_) std::rethrow_exception(failure_);
}

/// Meanwhile asks whether the work is still wanted, which no other thread may.
void WorkerPool::waitForOthers() {
  constexpr std::chrono::milliseconds kPeriod{10};
  std::unique_lock<std::mutex> lock(mutex_);
  const auto done = [this] { return busy_ == 0; };
  if (interruption_ == nullptr) return done_.wait(lock, done);
  while (!done_.wait_for(lock, kPeriod, done)) {
    lock.unlock();
    interruption_->poll();
    lock.lock();
  }
}

void WorkerPool::takeTurns() {
  const Interruption::Scope scope(interruption_);
  try {
    for (int i = next_++; i < count_; i = next_++) {
      checkpoint();
      (*task_)(i);
    }
  } catch (...) {
    const std::lock_guard<std::mutex> lock(mutex_);
    failure_ = std::current_exception();
  }
}

void WorkerPool::work() {
  unsigned long seen = 0;
  for (;;) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      start_.wait(lock, [&] { return stop_ || round_ != seen; });
      if (stop_) return;
      seen = round_;
    }
    takeTurns();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      --busy_;
    }
    done_.notify_one();
  }
}

}  // namespace uncertainty_identification
