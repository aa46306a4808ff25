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
#include "session/work_queue.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// Serves an action whose result has the codes OK and CANCELLED, and whose feedback is a Progress.
/// Goals are processed in a thread of its own, one at a time. A new goal cancels the running one
/// and all that wait. The client of a cancelled goal is answered at once; its work ends when it
/// next reports progress. A goal ends as succeeded if its result's code is OK, as preempted for
/// CANCELLED, and otherwise as aborted.
///
/// Uses ActionServer, because SimpleActionServer::isPreemptRequested() has a data race when it is
/// called from another thread.
template <typename Action>
class ActionThread {
 public:
  ACTION_DEFINITION(Action)

  /// Processes a goal. It calls the given function to report progress, and stops when that returns
  /// false. Must not throw.
  using Work = std::function<Result(const Goal&, const ProgressCallback&)>;

  ActionThread(const ros::NodeHandle& node, const std::string& name, Work work)
      : work_(std::move(work)),
        listener_(node),
        server_(
            listener_.node(), name, [this](Handle handle) { receive(std::move(handle)); },
            [this](const Handle& handle) { cancel(handle); }, false) {}

  /// Cancels the running goal and blocks until its work has ended.
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

  /// Number of goals that wait until the work for a cancelled one has ended.
  int waiting() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return static_cast<int>(std::count_if(open_.begin(), open_.end(), [](const auto& task) {
      return !task->begun && !task->cancelled;
    }));
  }

 private:
  static constexpr std::chrono::milliseconds kFeedbackPeriod{50};

  using Handle = typename actionlib::ActionServer<Action>::GoalHandle;

  struct Task {
    explicit Task(Handle of) : handle(std::move(of)) {}
    Handle handle;
    std::atomic<bool> cancelled{false}, begun{false};
    std::mutex mutex;  // guards `ended` and the end of the goal
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
    task.begun = true;
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
  mutable std::mutex mutex_;  // guards open_
  std::vector<std::shared_ptr<Task>> open_;
  std::thread thread_;
};

}  // namespace uncertainty_identification
