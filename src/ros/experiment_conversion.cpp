#include <map>

#include "data/text.h"
#include "io/printable.h"
#include "ros/message_conversions.h"
#include "ros/number_list.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

[[noreturn]] void fail(const messages::Experiment& message, const std::string& finding) {
  throw DataError("experiment '" + printable(message.id) + "': " + finding);
}

Eigen::VectorXd toVector(const std::vector<double>& list) {
  return Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
}

void requireLength(const messages::Experiment& message, const std::string& field,
                   std::size_t length, bool may_be_empty) {
  if (length == message.u.size() || (may_be_empty && length == 0)) return;
  fail(message, field + " has " + std::to_string(length) + " values, but u has " +
                    std::to_string(message.u.size()) + "; give one for each sample");
}

void requireName(const messages::Experiment& message, const std::string& what,
                 const std::string& name) {
  constexpr std::size_t kLongest = 200;
  if (name.size() <= kLongest) return;
  throw DataError("experiment '" + printable(message.id.substr(0, kLongest)) + "': " + what +
                  " has " + std::to_string(name.size()) + " characters; at most " +
                  std::to_string(kLongest) + " are allowed");
}

/// The first and the last sample must have stamps.
void requireTimes(const messages::Experiment& message) {
  if (!(message.sample_time > 0))
    fail(message, "sample_time is " + text(message.sample_time) + " s; it must be above 0");
  toStamp(
      message.header.stamp.toSec() + message.sample_time * static_cast<double>(message.u.size()),
      "experiment '" + printable(message.id) + "', time of its end");
}

void addCovariate(const messages::Experiment& message, const messages::Covariate& covariate,
                  Experiment& experiment) {
  requireName(message, "a covariate's name", covariate.name);
  const std::string own = printable(covariate.name), name = "covariate '" + own + "'";
  if (covariate.name.empty()) fail(message, "a covariate has no name; give each a name of its own");
  if (experiment.scalars.count(own) + experiment.signals.count(own) > 0)
    fail(message, name + " is given twice");
  if (covariate.kind == messages::Covariate::CONSTANT) {
    if (covariate.values.size() != 1)
      fail(message, name + " is constant but has " + std::to_string(covariate.values.size()) +
                        " values; give one");
    experiment.scalars[own] = covariate.values.front();
  } else if (covariate.kind == messages::Covariate::SIGNAL) {
    requireLength(message, name, covariate.values.size(), false);
    experiment.signals[own] = toVector(covariate.values);
  } else {
    fail(message, name + " is of kind " + std::to_string(covariate.kind) +
                      "; allowed: 0 (CONSTANT), 1 (SIGNAL)");
  }
}

messages::SignalTiming toMessage(const SignalTiming& timing) {
  messages::SignalTiming message;
  message.age = timing.age;
  message.delay = timing.delay;
  message.jitter = timing.jitter;
  message.lost = static_cast<std::uint32_t>(timing.lost);
  return message;
}

messages::Covariate covariateMessage(const std::string& name, std::uint8_t kind,
                                     std::vector<double> values) {
  messages::Covariate message;
  message.name = name;
  message.kind = kind;
  message.values = std::move(values);
  return message;
}

}  // namespace

messages::Experiment toMessage(const Experiment& experiment) {
  using messages::Covariate;
  messages::Experiment message;
  message.header.stamp =
      toStamp(experiment.start_time, "experiment '" + experiment.id + "', start time");
  message.id = experiment.id;
  message.sample_time = experiment.sample_time;
  message.u = toList(experiment.u);
  message.y = toList(experiment.y);
  message.valid = experiment.valid;
  message.stamp_offset = toList(experiment.stamp_offset);
  std::map<std::string, Covariate> covariates;  // both kinds, in order of their names
  for (const auto& [name, value] : experiment.scalars)
    covariates[name] = covariateMessage(name, Covariate::CONSTANT, {value});
  for (const auto& [name, signal] : experiment.signals)
    covariates[name] = covariateMessage(name, Covariate::SIGNAL, toList(signal));
  for (auto& [name, covariate] : covariates) message.covariates.push_back(std::move(covariate));
  return message;
}

Experiment fromMessage(const messages::Experiment& message, const LimitOptions& limits) {
  requireName(message, "its id", message.id);
  requireTimes(message);
  if (message.u.size() > static_cast<std::size_t>(limits.max_samples))
    fail(message, "it has " + std::to_string(message.u.size()) +
                      " samples, more than limits.max_samples; send it in parts, or raise that");
  requireLength(message, "y", message.y.size(), false);
  requireLength(message, "valid", message.valid.size(), true);
  requireLength(message, "stamp_offset", message.stamp_offset.size(), true);
  Experiment experiment;
  experiment.id = printable(message.id);
  experiment.sample_time = message.sample_time;
  experiment.start_time = message.header.stamp.toSec();
  experiment.u = toVector(message.u);
  experiment.y = toVector(message.y);
  experiment.valid = message.valid;
  experiment.stamp_offset = toVector(message.stamp_offset);
  for (const auto& covariate : message.covariates) addCovariate(message, covariate, experiment);
  return experiment;
}

messages::ExperimentSummary toMessage(const ExperimentDigest& digest) {
  messages::ExperimentSummary message;
  message.id = digest.id;
  message.start = toStamp(digest.start, "experiment '" + digest.id + "', start time");
  message.samples = static_cast<std::uint32_t>(digest.samples);
  message.sample_time = digest.sample_time;
  message.rejected = digest.rejected;
  message.input = toMessage(digest.timing.input);
  message.output = toMessage(digest.timing.output);
  message.clock_offset = digest.timing.clockOffset();
  return message;
}

}  // namespace uncertainty_identification
