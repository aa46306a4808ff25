#pragma once

#include <actionlib/client/action_client.h>

#include <mutex>
#include <vector>

namespace uncertainty_identification {

/// A goal of an action as its client sees it.
template <typename Action>
class SentGoal {
 public:
  ACTION_DEFINITION(Action)
  using Client = actionlib::ActionClient<Action>;

  SentGoal(Client& client, const Goal& goal)
      : handle_(client.sendGoal(
            goal, [this](const Handle& handle) { follow(handle); },
            [this](const Handle&, const FeedbackConstPtr& feedback) { hear(*feedback); })) {}

  bool ended() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ended_;
  }

  std::vector<Feedback> feedback() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return feedback_;
  }

  Result result() const { return *handle_.getResult(); }
  actionlib::TerminalState::StateEnum state() const { return handle_.getTerminalState().state_; }
  void cancel() { handle_.cancel(); }

 private:
  using Handle = typename Client::GoalHandle;

  void follow(const Handle& handle) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = handle.getCommState() == actionlib::CommState::DONE;
  }

  void hear(const Feedback& feedback) {
    const std::lock_guard<std::mutex> lock(mutex_);
    feedback_.push_back(feedback);
  }

  mutable std::mutex mutex_;
  bool ended_ = false;
  std::vector<Feedback> feedback_;
  Handle handle_;
};

}  // namespace uncertainty_identification
