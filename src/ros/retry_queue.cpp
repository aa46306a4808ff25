#include "ros/retry_queue.h"

#include <algorithm>
#include <utility>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

RetryQueue::RetryQueue(std::size_t most, std::chrono::milliseconds interval,
                       std::function<void()> changed)
    : most_(std::max<std::size_t>(1, most)),
      interval_(interval),
      changed_(std::move(changed)),
      thread_([this] { run(); }) {}

RetryQueue::~RetryQueue() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void RetryQueue::push(Task task, const std::string& key) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!key.empty()) {
      const auto same = [&](const Entry& entry) { return entry.key == key; };
      waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), same), waiting_.end());
    }
    waiting_.push_back({std::move(task), key});
    if (waiting_.size() > most_) {
      waiting_.pop_front();
      ++status_.lost;
    }
  }
  wake_.notify_one();
}

RetryQueue::Status RetryQueue::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  Status status = status_;
  status.waiting = static_cast<int>(waiting_.size()) + (busy_ ? 1 : 0);
  return status;
}

void RetryQueue::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    attempt(lock);
    if (stopping_ && status_.failing) return;
    if (status_.failing) wake_.wait_for(lock, interval_, [this] { return stopping_; });
  }
}

/// Does the oldest task without the lock, or puts it back.
void RetryQueue::attempt(std::unique_lock<std::mutex>& lock) {
  Entry entry = std::move(waiting_.front());
  waiting_.pop_front();
  busy_ = true;
  lock.unlock();
  std::string message;
  bool again = false;
  try {
    entry.task();
  } catch (const FileError& error) {
    message = error.what();
    again = true;
  } catch (const std::exception& error) {
    message = error.what();
  }
  lock.lock();
  busy_ = false;
  status_.failing = again;
  status_.message = message;
  if (again) waiting_.push_front(std::move(entry));
  if (!again && !message.empty()) ++status_.lost;
  lock.unlock();
  changed_();
  lock.lock();
}

}  // namespace uncertainty_identification
