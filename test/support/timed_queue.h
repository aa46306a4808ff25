#pragma once

#include <ros/callback_queue.h>
#include <ros/subscription_queue.h>

#include <boost/make_shared.hpp>
#include <chrono>
#include <ctime>
#include <functional>

namespace uncertainty_identification {

/// When a message was handed to the queue, when its callback began and ended, and what it computed.
struct CallbackTimes {
  using Clock = std::chrono::steady_clock;
  Clock::time_point arrived, began, ended;
  double computed = 0;  // [s] of the processor: what other programs do does not lengthen it
  const void* subscription = nullptr;

  double duration() const { return std::chrono::duration<double>(ended - began).count(); }
  double waited() const { return std::chrono::duration<double>(began - arrived).count(); }
};

/// A callback queue that times the callbacks of messages, in the thread that calls them.
class TimedQueue : public ros::CallbackQueue {
 public:
  explicit TimedQueue(std::function<void(const CallbackTimes&)> report)
      : report_(std::move(report)) {}

  void addCallback(const ros::CallbackInterfacePtr& callback, uint64_t owner) override {
    const bool message = dynamic_cast<ros::SubscriptionQueue*>(callback.get()) != nullptr;
    ros::CallbackQueue::addCallback(
        message ? boost::make_shared<Timed>(callback, report_) : callback, owner);
  }

 private:
  class Timed : public ros::CallbackInterface {
   public:
    Timed(ros::CallbackInterfacePtr callback,
          const std::function<void(const CallbackTimes&)>& report)
        : callback_(std::move(callback)), report_(report) {
      times_.arrived = CallbackTimes::Clock::now();
      times_.subscription = callback_.get();
    }

    bool ready() override { return callback_->ready(); }

    CallResult call() override {
      times_.began = CallbackTimes::Clock::now();
      const double before = processorTime();
      const CallResult result = callback_->call();
      times_.computed = processorTime() - before;
      times_.ended = CallbackTimes::Clock::now();
      if (result == Success) report_(times_);
      return result;
    }

   private:
    static double processorTime() {  // [s] of this thread
      timespec time;
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
      return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    ros::CallbackInterfacePtr callback_;
    const std::function<void(const CallbackTimes&)>& report_;
    CallbackTimes times_;
  };

  const std::function<void(const CallbackTimes&)> report_;
};

}  // namespace uncertainty_identification
