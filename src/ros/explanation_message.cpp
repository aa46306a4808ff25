#include "ros/explanation_message.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "uncertainty_identification/io/explanation_json.h"

namespace uncertainty_identification {
namespace {

std::uint8_t toMessage(Verdict verdict) {
  switch (verdict) {
    case Verdict::none:
      return messages::Explanation::NONE;
    case Verdict::explained:
      return messages::Explanation::EXPLAINED;
    case Verdict::partly_explained:
      return messages::Explanation::PARTLY_EXPLAINED;
    case Verdict::unknown:
      return messages::Explanation::UNKNOWN;
  }
  throw std::invalid_argument("a verdict outside its enumeration");
}

std::vector<messages::Check> toMessage(const std::vector<Check>& checks) {
  std::vector<messages::Check> list;
  for (const Check& check : checks) {
    messages::Check message;
    message.name = check.name;
    message.statistic = check.statistic;
    message.p_value = check.p_value;
    message.passed = check.passed;
    message.where = check.where;
    list.push_back(message);
  }
  return list;
}

std::vector<messages::CauseParameter> toMessage(const std::vector<CauseParameter>& parameters) {
  std::vector<messages::CauseParameter> list;
  for (const CauseParameter& parameter : parameters) {
    messages::CauseParameter message;
    message.name = parameter.name;
    message.unit = parameter.unit;
    message.value = parameter.value;
    message.standard_error = parameter.standard_error;
    message.lower_90 = parameter.lower_90;
    message.upper_90 = parameter.upper_90;
    list.push_back(message);
  }
  return list;
}

void fill(const Gain& gain, messages::Cause* message) {
  message->gain = gain.log_density;
  message->gain_standard_error = gain.standard_error;
  message->fit_before = gain.nrmse_fit_percent.before;
  message->fit_after = gain.nrmse_fit_percent.after;
  message->coverage_50_before = gain.coverage_50.before;
  message->coverage_50_after = gain.coverage_50.after;
  message->coverage_90_before = gain.coverage_90.before;
  message->coverage_90_after = gain.coverage_90.after;
  message->coverage_95_before = gain.coverage_95.before;
  message->coverage_95_after = gain.coverage_95.after;
  message->noise_variance_before = gain.noise_variance.before;
  message->noise_variance_after = gain.noise_variance.after;
  message->bode_area_before = gain.bode_area.before;
  message->bode_area_after = gain.bode_area.after;
}

Gain noGain() {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Comparison none{kNan, kNan};
  return {kNan, kNan, kNan, kNan, none, none, none, none, none, none};
}

void fill(const SimulationCause& cause, messages::Cause* message) {
  message->place = cause.what.place;
  message->shape = cause.what.shape;
  for (const PlaceAndShape& tie : cause.ties) message->ties.push_back(tie.place + ": " + tie.shape);
  message->curve_of = cause.curve.of;
  message->curve_signal = cause.curve.signal;
  message->curve_value = cause.curve.value;
  message->curve_lower_90 = cause.curve.lower_90;
  message->curve_upper_90 = cause.curve.upper_90;
}

messages::Cause toMessage(const Cause& cause) {
  messages::Cause message;
  message.name = cause.name;
  message.variant = cause.variant;
  message.group = cause.group;
  message.description = cause.description;
  message.confidence = cause.confidence;
  message.equivalent = cause.equivalent;
  message.parameters = toMessage(cause.parameters);
  message.advice = cause.advice;
  if (cause.simulation) fill(*cause.simulation, &message);
  message.has_gain = cause.gain.has_value();
  fill(cause.gain.value_or(noGain()), &message);
  return message;
}

messages::TriedEffect toMessage(const TriedEffect& tried) {
  messages::TriedEffect message;
  message.name = tried.name;
  message.variant = tried.variant;
  message.score = tried.score;
  message.held_out_gain = tried.held_out_gain;
  message.standard_error = tried.standard_error;
  return message;
}

}  // namespace

messages::Explanation toMessage(const Explanation& explanation, const ros::Time& stamp,
                                std::uint32_t sequence) {
  messages::Explanation message;
  message.header.stamp = stamp;
  message.sequence = sequence;
  message.verdict = toMessage(explanation.verdict);
  message.message = explanation.message;
  message.checks_before = toMessage(explanation.checks_before);
  message.checks_after = toMessage(explanation.checks_after);
  for (const Cause& cause : explanation.causes) message.causes.push_back(toMessage(cause));
  for (const TriedEffect& tried : explanation.candidates)
    message.candidates.push_back(toMessage(tried));
  message.held_out = explanation.held_out;
  message.warnings = explanation.warnings;
  message.seconds = explanation.seconds;
  // Ids come from users and may not be valid UTF-8; invalid bytes are replaced instead of throwing.
  message.explanation_json =
      toJson(explanation).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return message;
}

}  // namespace uncertainty_identification
