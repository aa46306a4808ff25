#pragma once

#include <actionlib/server/action_server.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "ros/service_thread.h"
#include "ros/work_queue.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// Answers an action whose result has the codes OK and CANCELLED, and whose feedback is a Progress.
/// Goals are worked on in a thread
/// of its own, one at a time: a new one preempts the one that runs, and those that wait. Who
/// cancels is answered at once; the work ends when it asks next whether to go on. A goal succeeds
/// when its result's code is OK, is told as preempted for CANCELLED, and else as aborted; the
/// result says more in each case.
///
/// Written on ActionServer because SimpleActionServer::isPreemptRequested() is a race when another
/// thread asks.
template <typename Action>
class ActionThread {
 public:
  ACTION_DEFINITION(Action)

  /// Carries a goal out; the callback publishes feedback and tells to leave the goal, by false.
  /// Must not throw.
  using Work = std::function<Result(const Goal&, const ProgressCallback&)>;

  ActionThread(const ros::NodeHandle& node, const std::string& name, Work work)
      : work_(std::move(work)),
        listener_(node),
        server_(
            listener_.node(), name, [this](Handle handle) { receive(std::move(handle)); },
            [this](const Handle& handle) { cancel(handle); }, false) {}

  /// Cancels what runs and waits for its end.
  ~ActionThread() {
    listener_.stop();
    cancelAll();
    queue_.close();
    if (thread_.joinable()) thread_.join();
  }

  void start() {
    thread_ = std::thread([this] { run(); });
    server_.start();
    listener_.start();
  }

 private:
  static constexpr std::chrono::milliseconds kFeedbackPeriod{50};

  using Handle = typename actionlib::ActionServer<Action>::GoalHandle;

  struct Task {
    explicit Task(Handle of) : handle(std::move(of)) {}
    Handle handle;
    std::atomic<bool> cancelled{false};
    std::mutex mutex;  // guards what follows, and the end of the goal
    bool ended = false;
  };

  void receive(Handle handle) {
    cancelAll();
    auto task = std::make_shared<Task>(std::move(handle));
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      open_.push_back(task);
    }
    queue_.push(std::move(task));
  }

  void cancel(const Handle& handle) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& task : open_)
      if (task->handle == handle) cancel(*task);
  }

  void cancelAll() {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& task : open_) cancel(*task);
  }

  static void cancel(Task& task) {
    task.cancelled = true;
    Result result;
    result.code = Result::CANCELLED;
    result.message = "cancelled";
    end(task, result);
  }

  void run() {
    for (auto tasks = queue_.takeAll(); !tasks.empty(); tasks = queue_.takeAll()) {
      for (const auto& task : tasks) {
        if (!task->cancelled) carryOut(*task);
        const std::lock_guard<std::mutex> lock(mutex_);
        open_.erase(std::remove(open_.begin(), open_.end(), task), open_.end());
      }
    }
  }

  void carryOut(Task& task) {
    if (!accept(task)) return;
    auto due = std::chrono::steady_clock::now();
    end(task, work_(*task.handle.getGoal(), [&task, &due](const Progress& progress) {
          const auto now = std::chrono::steady_clock::now();
          if (now >= due && !task.cancelled) {
            task.handle.publishFeedback(feedbackOf(progress));
            due = now + kFeedbackPeriod;
          }
          return !task.cancelled;
        }));
  }

  static bool accept(Task& task) {
    const std::lock_guard<std::mutex> lock(task.mutex);
    if (!task.ended) task.handle.setAccepted();
    return !task.ended;
  }

  static Feedback feedbackOf(const Progress& progress) {
    Feedback feedback;
    feedback.phase = progress.phase;
    feedback.fraction = progress.fraction;
    feedback.log_likelihood =
        progress.log_likelihood.value_or(std::numeric_limits<double>::quiet_NaN());
    return feedback;
  }

  static void end(Task& task, const Result& result) {
    const std::lock_guard<std::mutex> lock(task.mutex);
    if (std::exchange(task.ended, true)) return;
    if (result.code == Result::OK) return task.handle.setSucceeded(result, result.message);
    if (result.code == Result::CANCELLED) return task.handle.setCanceled(result, result.message);
    task.handle.setAborted(result, result.message);
  }

  const Work work_;
  ServiceThread listener_;
  actionlib::ActionServer<Action> server_;
  WorkQueue<std::shared_ptr<Task>> queue_;
  std::mutex mutex_;  // guards open_
  std::vector<std::shared_ptr<Task>> open_;
  std::thread thread_;
};

}  // namespace uncertainty_identification
