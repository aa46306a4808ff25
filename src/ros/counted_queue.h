#pragma once

#include <ros/callback_queue.h>

#include <atomic>
#include <boost/make_shared.hpp>
#include <memory>

namespace uncertainty_identification {

/// A callback queue that counts the callbacks which wait to be called.
class CountedQueue : public ros::CallbackQueue {
 public:
  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override {
    ros::CallbackQueue::addCallback(boost::make_shared<Counted>(callback, waiting_), owner);
  }

  int waiting() const { return *waiting_; }

 private:
  using Count = std::shared_ptr<std::atomic<int>>;

  /// Counts from its construction until it is called or, if the caller has gone, destroyed.
  class Counted : public ros::CallbackInterface {
   public:
    Counted(const ros::CallbackInterfacePtr& callback, const Count& count)
        : callback_(callback), count_(count) {
      ++*count_;
    }
    ~Counted() override { begin(); }
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;

    CallResult call() override {
      begin();
      return callback_->call();
    }
    bool ready() override { return callback_->ready(); }

   private:
    void begin() {
      if (!begun_.exchange(true)) --*count_;
    }

    const ros::CallbackInterfacePtr callback_;
    const Count count_;
    std::atomic<bool> begun_{false};
  };

  const Count waiting_ = std::make_shared<std::atomic<int>>(0);
};

}  // namespace uncertainty_identification
