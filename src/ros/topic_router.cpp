#include "uncertainty_identification/ros/topic_router.h"

#include <std_msgs/Bool.h>

#include <utility>

#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/ros/deserialise.h"
#include "uncertainty_identification/ros/messages.h"

namespace uncertainty_identification {

TopicRouter::TopicRouter(const Configuration& configuration, const TopicResolver& resolve)
    : cutter_(configuration.experiment, configuration.limits) {
  addRoute("input", configuration.input, resolve,
           [this](StampedValue sample) { cutter_.addInput(sample.stamp, sample.value); });
  addRoute("output", configuration.output, resolve,
           [this](StampedValue sample) { cutter_.addOutput(sample.stamp, sample.value); });
  for (const auto& covariate : configuration.covariates) {
    addRoute("covariate '" + covariate.name + "'", covariate, resolve,
             [this, name = covariate.name](StampedValue sample) {
               cutter_.addCovariate(name, sample.stamp, sample.value);
             });
  }
  if (configuration.experiment.mode == ExperimentMode::topic)
    marker_topic_ = resolve(configuration.experiment.topic);
}

void TopicRouter::addRoute(const std::string& key, const SignalOptions& signal,
                           const TopicResolver& resolve,
                           std::function<void(StampedValue)> deliver) {
  routes_.push_back(
      {key, SignalDecoder(resolve(signal.topic), signal.field), std::move(deliver), 0, ""});
}

std::vector<TopicRouter::Use> TopicRouter::uses() const {
  std::vector<Use> uses;
  for (const auto& route : routes_) uses.push_back({route.decoder.topic(), route.key});
  if (!marker_topic_.empty()) uses.push_back({marker_topic_, "experiment.topic"});
  return uses;
}

void TopicRouter::add(const std::string& topic, const RawMessage& message) {
  for (auto& route : routes_) {
    if (route.decoder.topic() != topic) continue;
    try {
      route.deliver(route.decoder.decode(message));
    } catch (const DataError& error) {
      if (route.left_out++ == 0) route.reason = error.what();
    }
  }
  if (!marker_topic_.empty() && topic == marker_topic_) addMarker(message);
}

void TopicRouter::addMarker(const RawMessage& message) {
  try {
    if (message.type == ros::message_traits::datatype<std_msgs::Bool>()) {
      cutter_.addMarker(message.receipt, deserialise<std_msgs::Bool>(message).data != 0);
    } else if (message.type == ros::message_traits::datatype<messages::ExperimentMarker>()) {
      const auto marker = deserialise<messages::ExperimentMarker>(message);
      cutter_.addMarker(marker.header.stamp.toSec(), marker.active != 0, marker.id);
    } else {
      throw ConfigurationError("topic '" + marker_topic_ + "' of type " + message.type +
                               " cannot mark experiments (experiment.topic); it must be "
                               "std_msgs/Bool or uncertainty_identification/ExperimentMarker");
    }
  } catch (const DataError&) {
    ++broken_markers_;
  }
}

std::vector<std::string> TopicRouter::stampedOnReceipt() const {
  std::vector<std::string> topics;
  for (const auto& route : routes_)
    if (route.decoder.stampedOnReceipt()) topics.push_back(route.decoder.topic());
  return topics;
}

std::vector<std::string> TopicRouter::warnings() const {
  std::vector<std::string> warnings;
  for (const auto& route : routes_) {
    if (route.left_out == 0) continue;
    warnings.push_back(route.key + ": " + std::to_string(route.left_out) + " messages of topic '" +
                       route.decoder.topic() + "' were left out; the first because " +
                       route.reason);
  }
  if (broken_markers_ > 0)
    warnings.push_back(std::to_string(broken_markers_) + " broken markers on topic '" +
                       marker_topic_ + "' were left out");
  return warnings;
}

}  // namespace uncertainty_identification
