#include "uncertainty_identification/ros/result_publisher.h"

#include "uncertainty_identification/ros/message_conversions.h"

namespace uncertainty_identification {

ResultPublisher::ResultPublisher(ros::NodeHandle node)
    : result_(node.advertise<messages::IdentificationResult>("result", 1, true)),
      nominal_model_(node.advertise<messages::NominalModel>("nominal_model", 1, true)),
      error_model_(node.advertise<messages::ErrorModel>("error_model", 1, true)) {}

ResultContext ResultPublisher::publish(const WorkerResult& result) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const ResultContext context{ros::Time::now(), ++count_, result.preliminary, result.window};
  last_ = toMessage(*result.estimate, context);
  last_estimate_ = result.estimate;
  nominal_model_.publish(last_->nominal_model);
  error_model_.publish(last_->error_model);
  result_.publish(*last_);
  return context;
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

void ResultPublisher::forget() {
  const std::lock_guard<std::mutex> lock(mutex_);
  last_.reset();
  last_estimate_.reset();
}

}  // namespace uncertainty_identification
