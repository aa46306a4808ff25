#include "session/retry_queue.h"

#include <algorithm>
#include <utility>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

RetryQueue::RetryQueue(std::size_t capacity, std::chrono::milliseconds interval,
                       std::function<void()> attempted)
    : capacity_(std::max<std::size_t>(1, capacity)),
      interval_(interval),
      attempted_(std::move(attempted)),
      thread_([this] { run(); }) {}

RetryQueue::~RetryQueue() { stop(); }

std::vector<std::string> RetryQueue::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
  std::vector<std::string> left;
  for (const Entry& entry : waiting_) left.push_back(entry.what);
  return left;
}

void RetryQueue::push(Task task, const std::string& key, const std::string& what) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!key.empty()) {
      const auto same = [&](const Entry& entry) { return entry.key == key; };
      waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), same), waiting_.end());
    }
    waiting_.push_back({std::move(task), key, what});
    if (waiting_.size() > capacity_) {
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

/// Runs the oldest task with the mutex released. Puts it back to the front when it has to be
/// retried.
void RetryQueue::attempt(std::unique_lock<std::mutex>& lock) {
  Entry entry = std::move(waiting_.front());
  waiting_.pop_front();
  busy_ = true;
  lock.unlock();
  std::string message;
  bool retry = false;
  try {
    entry.task();
  } catch (const FileError& error) {
    message = error.what();
    retry = true;
  } catch (const std::exception& error) {
    message = error.what();
  }
  lock.lock();
  busy_ = false;
  status_.failing = retry;
  status_.message = message;
  if (retry) waiting_.push_front(std::move(entry));
  if (!retry && !message.empty()) ++status_.lost;
  lock.unlock();
  attempted_();
  lock.lock();
}

}  // namespace uncertainty_identification
