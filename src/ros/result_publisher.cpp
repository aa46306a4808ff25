#include "ros/result_publisher.h"

#include "ros/message_conversions.h"

namespace uncertainty_identification {

ResultPublisher::ResultPublisher(ros::NodeHandle node)
    : result_(node.advertise<messages::IdentificationResult>("result", 1, true)),
      nominal_model_(node.advertise<messages::NominalModel>("nominal_model", 1, true)),
      error_model_(node.advertise<messages::ErrorModel>("error_model", 1, true)) {}

ResultContext ResultPublisher::publish(const WorkerResult& result) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const ResultContext context{ros::Time::now().toNSec(), count_ + 1, result.preliminary,
                              result.window};
  publishLocked(result.estimate, context);
  return context;
}

void ResultPublisher::publishAgain(std::shared_ptr<const Estimate> estimate,
                                   const ResultContext& context) {
  const std::lock_guard<std::mutex> lock(mutex_);
  publishLocked(std::move(estimate), context);
}

void ResultPublisher::publishLocked(std::shared_ptr<const Estimate> estimate,
                                    const ResultContext& context) {
  count_ = context.sequence;
  last_ = toMessage(*estimate, context);
  last_estimate_ = std::move(estimate);
  nominal_model_.publish(last_->nominal_model);
  error_model_.publish(last_->error_model);
  result_.publish(*last_);
}

std::optional<messages::IdentificationResult> ResultPublisher::last() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_;
}

std::pair<std::shared_ptr<const Estimate>, std::uint32_t> ResultPublisher::lastEstimate() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {last_estimate_, last_ ? last_->sequence : 0};
}

std::uint32_t ResultPublisher::sequence() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_ ? last_->sequence : 0;
}

std::uint32_t ResultPublisher::forget() {
  const std::lock_guard<std::mutex> lock(mutex_);
  last_.reset();
  last_estimate_.reset();
  return count_;
}

}  // namespace uncertainty_identification
