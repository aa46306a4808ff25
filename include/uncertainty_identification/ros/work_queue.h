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

  /// Waits for items and takes all of them, in order. Empty once the queue is closed, whatever was
  /// left in it.
  std::vector<Item> takeAll() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !items_.empty(); });
    return closed_ ? std::vector<Item>() : std::exchange(items_, {});
  }

  std::size_t size() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return items_.size();
  }

  void clear() {
    const std::lock_guard<std::mutex> lock(mutex_);
    items_.clear();
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
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Item> items_;
  bool closed_ = false;
};

}  // namespace uncertainty_identification
