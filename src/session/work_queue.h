#pragma once

#include <condition_variable>
#include <mutex>
#include <utility>
#include <vector>

namespace uncertainty_identification {

/// Passes items from any number of threads to one thread that processes them in order.
template <typename Item>
class WorkQueue {
 public:
  /// Appends an item and wakes the thread that waits in takeAll(). May be called from any thread.
  void push(Item item) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      items_.push_back(std::move(item));
    }
    changed_.notify_one();
  }

  /// Waits until there are items or the queue is closed, then removes and returns all items in the
  /// order of push(). An empty list means that the queue is closed and everything was taken.
  std::vector<Item> takeAll() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !items_.empty(); });
    return std::exchange(items_, {});
  }

  /// From now on takeAll() never waits. Items that are still in the queue can be taken.
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
