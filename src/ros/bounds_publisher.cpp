#include "ros/bounds_publisher.h"

#include <exception>
#include <utility>

#include "math/interruption.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

BoundsPublisher::BoundsPublisher(ros::NodeHandle node, Begins begins, Done done)
    : begins_(std::move(begins)),
      done_(std::move(done)),
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

void BoundsPublisher::add(const Result& result, const ResultContext& context) {
  if (result.estimate.configuration.bounds.frequencies == 0) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    newest_ = Request{result, context};
  }
  changed_.notify_one();
}

std::optional<Result> BoundsPublisher::resultOf(std::uint32_t sequence) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_sequence_ == sequence ? last_ : std::nullopt;
}

void BoundsPublisher::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || newest_; });
    if (stopping_) return;
    Request request = *std::exchange(newest_, std::nullopt);
    lock.unlock();
    publish(std::move(request));
    lock.lock();
  }
}

void BoundsPublisher::publish(Request request) {
  const auto running =
      begins_("computing the bounds of result " + std::to_string(request.context.sequence));
  const Interruption interruption([this] { return stopping_.load(); });
  try {
    request.result.bounds = computeBounds(request.result.estimate);
    publisher_.publish(toMessage(*request.result.bounds, request.context));
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      last_ = request.result;
      last_sequence_ = request.context.sequence;
    }
    done_(request.result, request.context);
  } catch (const CancelledError&) {        // the node ends
  } catch (const std::exception& error) {  // costs only the bounds; the node keeps running
    ROS_WARN_STREAM("result " << request.context.sequence << " has no bounds: " << error.what());
  }
}

}  // namespace uncertainty_identification
