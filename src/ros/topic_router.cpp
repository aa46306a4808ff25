#include "ros/topic_router.h"

#include <std_msgs/Bool.h>

#include <cmath>
#include <utility>

#include "data/text.h"
#include "io/printable.h"
#include "ros/deserialise.h"
#include "ros/messages.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

TopicRouter::TopicRouter(const Configuration& configuration, const TopicResolver& resolve)
    : cutter_(configuration.experiment, configuration.limits) {
  addRoute(TopicRole::input, "input", configuration.input, resolve, [this](StampedValue sample) {
    cutter_.addInput(sample.stamp, sample.value, sample.arrival);
  });
  addRoute(TopicRole::output, "output", configuration.output, resolve, [this](StampedValue sample) {
    cutter_.addOutput(sample.stamp, sample.value, sample.arrival);
  });
  for (const auto& covariate : configuration.covariates) {
    if (covariate.topic.empty()) continue;  // it is a column of files
    addRoute(TopicRole::covariate, "covariate '" + covariate.name + "'", covariate, resolve,
             [this, name = covariate.name](StampedValue sample) {
               cutter_.addCovariate(name, sample.stamp, sample.value);
             });
  }
  if (configuration.experiment.mode == ExperimentMode::topic)
    marker_topic_ = resolve(configuration.experiment.topic);
  marker_count_ = {"experiment.topic", marker_topic_, TopicRole::marker};
}

void TopicRouter::addRoute(TopicRole role, const std::string& key, const SignalOptions& signal,
                           const TopicResolver& resolve,
                           std::function<void(StampedValue)> deliver) {
  const std::string topic = resolve(signal.topic);
  routes_.push_back(
      {SignalDecoder(topic, signal.field), signal, std::move(deliver), {key, topic, role}});
}

std::vector<TopicRouter::Use> TopicRouter::uses() const {
  std::vector<Use> uses;
  const auto add = [&uses](const Count& count) {
    uses.push_back({count.topic, count.key, count.role, count.left_out, count.not_finite});
  };
  for (const auto& route : routes_) add(route.count);
  if (!marker_topic_.empty()) add(marker_count_);
  return uses;
}

void TopicRouter::add(const std::string& topic, const RawMessage& message) {
  for (auto& route : routes_) {
    if (route.decoder.topic() != topic) continue;
    try {
      StampedValue sample = route.decoder.decode(message);
      sample.value = route.signal.scaled(sample.value);
      ++route.count.received;
      if (!std::isfinite(sample.value)) countNotFinite(route.count, sample.value);
      route.deliver(sample);
    } catch (const DataError& error) {
      countLeftOut(route.count, error.what());
    } catch (const ConfigurationError&) {
      ++route.count.left_out;
      throw;
    }
  }
  if (!marker_topic_.empty() && topic == marker_topic_) addMarker(message);
}

void TopicRouter::addMarker(const RawMessage& message) {
  try {
    if (message.type == ros::message_traits::datatype<std_msgs::Bool>()) {
      requireReceipt(message);
      cutter_.addMarker(message.receipt, deserialise<std_msgs::Bool>(message).data != 0);
    } else if (message.type == ros::message_traits::datatype<messages::ExperimentMarker>()) {
      const auto marker = deserialise<messages::ExperimentMarker>(message);
      cutter_.addMarker(marker.header.stamp.toSec(), marker.active != 0, printable(marker.id));
    } else {
      throw ConfigurationError("topic '" + marker_topic_ + "' of type " + message.type +
                               " cannot mark experiments (experiment.topic); it must be "
                               "std_msgs/Bool or uncertainty_identification/ExperimentMarker");
    }
  } catch (const DataError& error) {
    countLeftOut(marker_count_, error.what());
  } catch (const ConfigurationError&) {
    ++marker_count_.left_out;
    throw;
  }
}

/// What becomes of such samples is up to the checks: an output counts as missing.
void TopicRouter::countNotFinite(Count& count, double value) {
  if (count.not_finite++ > 0) return;
  problems_.push_back(count.key + ": a sample of topic '" + count.topic + "' is " + text(value) +
                      "; as an output it counts as missing, as an input or covariate it makes the "
                      "experiment unusable; check the sensor");
}

void TopicRouter::countLeftOut(Count& count, const std::string& reason) {
  ++count.left_out;
  if (!count.reason.empty()) return;
  count.reason = reason;
  problems_.push_back(count.key + ": a message of topic '" + count.topic +
                      "' was left out because " + reason);
}

std::vector<std::string> TopicRouter::takeProblems() { return std::exchange(problems_, {}); }

std::vector<std::string> TopicRouter::stampedOnReceipt() const {
  std::vector<std::string> topics;
  for (const auto& route : routes_)
    if (route.decoder.stampedOnReceipt()) topics.push_back(route.decoder.topic());
  return topics;
}

std::vector<std::string> TopicRouter::warnings() const {
  std::vector<std::string> warnings;
  const auto add = [&warnings](const Count& count) {
    if (count.not_finite > 0)
      warnings.push_back(count.key + ": " + std::to_string(count.not_finite) + " of " +
                         std::to_string(count.received) + " samples of topic '" + count.topic +
                         "' are NaN or infinite; as an output they count as missing, as an input "
                         "or covariate they make the experiment unusable");
    if (count.left_out == 0) return;
    warnings.push_back(count.key + ": " + std::to_string(count.left_out) + " messages of topic '" +
                       count.topic + "' were left out; the first because " + count.reason);
  };
  for (const auto& route : routes_) add(route.count);
  add(marker_count_);
  return warnings;
}

}  // namespace uncertainty_identification
