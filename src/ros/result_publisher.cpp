#include "uncertainty_identification/ros/result_publisher.h"

#include "uncertainty_identification/ros/message_conversions.h"

namespace uncertainty_identification {

ResultPublisher::ResultPublisher(ros::NodeHandle node)
    : result_(node.advertise<messages::IdentificationResult>("result", 1, true)),
      nominal_model_(node.advertise<messages::NominalModel>("nominal_model", 1, true)),
      error_model_(node.advertise<messages::ErrorModel>("error_model", 1, true)) {}

void ResultPublisher::publish(const WorkerResult& result) {
  const std::lock_guard<std::mutex> lock(mutex_);
  last_ =
      toMessage(*result.estimate, {ros::Time::now(), ++count_, result.preliminary, result.window});
  nominal_model_.publish(last_->nominal_model);
  error_model_.publish(last_->error_model);
  result_.publish(*last_);
}

std::optional<messages::IdentificationResult> ResultPublisher::last() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_;
}

std::uint32_t ResultPublisher::sequence() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_ ? last_->sequence : 0;
}

void ResultPublisher::forget() {
  const std::lock_guard<std::mutex> lock(mutex_);
  last_.reset();
}

}  // namespace uncertainty_identification
