#pragma once

#include <condition_variable>
#include <mutex>
#include <utility>
#include <vector>

namespace uncertainty_identification {

/// Hands items from any thread to one that works on them.
template <typename Item>
class WorkQueue {
 public:
  void push(Item item) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      items_.push_back(std::move(item));
    }
    changed_.notify_one();
  }

  /// Waits for items and takes all of them, in order. Empty once the queue is closed and nothing is
  /// left in it.
  std::vector<Item> takeAll() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !items_.empty(); });
    return std::exchange(items_, {});
  }

  /// Ends all waiting, now and later.
  void close() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Item> items_;
  bool closed_ = false;
};

}  // namespace uncertainty_identification
