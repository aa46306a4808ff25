#include "uncertainty_identification/ros/bounds_publisher.h"

#include <utility>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

BoundsPublisher::BoundsPublisher(ros::NodeHandle node, const BoundsOptions& options)
    : wanted_(options.frequencies > 0),
      publisher_(node.advertise<messages::UncertaintyBounds>("uncertainty_bounds", 1, true)),
      thread_([this] { run(); }) {}

BoundsPublisher::~BoundsPublisher() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void BoundsPublisher::add(std::shared_ptr<const Estimate> estimate, const ResultContext& context) {
  if (!wanted_) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    newest_ = Request{std::move(estimate), context};
  }
  changed_.notify_one();
}

void BoundsPublisher::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || newest_; });
    if (stopping_) return;
    const Request request = *std::exchange(newest_, std::nullopt);
    lock.unlock();
    publish(request);
    lock.lock();
  }
}

void BoundsPublisher::publish(const Request& request) {
  try {
    publisher_.publish(toMessage(computeBounds(*request.estimate), request.context));
  } catch (const Error& error) {
    ROS_WARN_STREAM("result " << request.context.sequence << " has no bounds: " << error.what());
  }
}

}  // namespace uncertainty_identification
