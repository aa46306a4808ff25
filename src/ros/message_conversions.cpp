#include "ros/message_conversions.h"

#include <nlohmann/json.hpp>

#include "data/text.h"
#include "ros/number_list.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/configuration_yaml.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {
namespace {

std::vector<messages::Parameter> toMessage(const std::vector<ParameterEstimate>& parameters) {
  std::vector<messages::Parameter> list;
  for (const auto& parameter : parameters) {
    messages::Parameter message;
    message.name = parameter.name;
    message.unit = parameter.unit;
    message.value = parameter.value;
    message.standard_error = parameter.standard_error;
    message.robust_standard_error = parameter.robust_standard_error;
    list.push_back(message);
  }
  return list;
}

std::uint8_t toMessage(BasisKind basis) {
  switch (basis) {
    case BasisKind::fir:
    case BasisKind::automatic:  // as ErrorBasis takes it
      return messages::ErrorModel::FIR;
    case BasisKind::laguerre:
      return messages::ErrorModel::LAGUERRE;
    case BasisKind::kautz:
      return messages::ErrorModel::KAUTZ;
    case BasisKind::sensitivity:
      return messages::ErrorModel::SENSITIVITY;
    case BasisKind::parameter_spread:
      return messages::ErrorModel::PARAMETER_SPREAD;
  }
  throw std::invalid_argument("a basis outside its enumeration");
}

std::uint8_t toMessage(Constraint constraint) {
  switch (constraint) {
    case Constraint::zero_static_gain:
      return messages::ErrorModel::ZERO_STATIC_GAIN;
    case Constraint::zero_mean:
      return messages::ErrorModel::ZERO_MEAN;
    case Constraint::free:
      return messages::ErrorModel::FREE;
    case Constraint::explicit_matrix:
      return messages::ErrorModel::EXPLICIT;
  }
  throw std::invalid_argument("a constraint outside its enumeration");
}

void fillPole(const ErrorModelOptions& options, messages::ErrorModel& message) {
  if (options.basis == BasisKind::laguerre) message.pole_real = options.pole;
  if (options.basis != BasisKind::kautz) return;
  message.pole_real = options.pole_real;
  message.pole_imaginary = options.pole_imag;
}

std::uint8_t sensitivityOrder(const ErrorModelOptions& options) {
  if (options.basis == BasisKind::parameter_spread) return 1;
  if (options.basis != BasisKind::sensitivity) return 0;
  return static_cast<std::uint8_t>(options.sensitivity_order);
}

}  // namespace

std::uint8_t toMessage(Termination termination) {
  using Result = messages::IdentificationResult;
  switch (termination) {
    case Termination::not_run:
      return Result::NOT_RUN;
    case Termination::converged:
      return Result::CONVERGED;
    case Termination::iteration_limit:
      return Result::ITERATION_LIMIT;
    case Termination::stalled:
      return Result::STALLED;
    case Termination::cancelled:
      return Result::CANCELLED;
    case Termination::time_limit:
      return Result::TIME_LIMIT;
  }
  throw std::invalid_argument("a termination outside its enumeration");
}

ros::Time toStamp(double seconds, const std::string& what) {
  if (!(seconds >= 0 && seconds < 4294967295.0))
    throw DataError(what + ": " + text(seconds) +
                    " s does not fit a ROS stamp, which counts seconds from 0 to 2^32 - 1");
  return ros::Time(seconds);
}

ros::Time stampOf(const ResultContext& context) { return ros::Time().fromNSec(context.stamp); }

messages::NominalModel toNominalModelMessage(const Estimate& estimate,
                                             const ResultContext& context) {
  const auto& model = estimate.nominal_model;
  messages::NominalModel message;
  message.header.stamp = stampOf(context);
  message.sequence = context.sequence;
  message.structure = model.structure;
  message.sample_time = model.sample_time;
  message.delay = static_cast<std::uint32_t>(model.delay);
  message.b = toList(model.b);
  message.a = toList(model.a);
  message.c = toList(model.c);
  message.d = toList(model.d);
  message.parameters = toMessage(model.parameters);
  message.covariance = toRowMajor(model.covariance);
  message.noise_variance = estimate.noise_variance.value;
  message.noise_variance_standard_error = estimate.noise_variance.standard_error;
  message.offset_u = estimate.offset_u;
  message.offset_y = estimate.offset_y;
  return message;
}

messages::ErrorModel toErrorModelMessage(const Estimate& estimate, const ResultContext& context) {
  const auto& model = estimate.error_model;
  messages::ErrorModel message;
  message.header.stamp = stampOf(context);
  message.sequence = context.sequence;
  message.sample_time = estimate.nominal_model.sample_time;
  message.basis = toMessage(model.options.basis);
  message.taps = static_cast<std::uint32_t>(model.T.rows());
  fillPole(model.options, message);
  message.sensitivity_order = sensitivityOrder(model.options);
  if (message.sensitivity_order > 0) message.varied_parameters = model.options.parameters;
  message.constraint = toMessage(model.options.constraint);
  message.dimension = static_cast<std::uint32_t>(model.mixture.dimension());
  message.T = toRowMajor(model.T);
  for (std::size_t i = 0; i < model.mixture.weights.size(); ++i) {
    messages::GaussianComponent component;
    component.weight = model.mixture.weights[i];
    component.mean = toList(model.mixture.means[i]);
    component.covariance = toRowMajor(model.mixture.covariances[i]);
    message.components.push_back(component);
  }
  message.parameters = toMessage(model.parameters);
  return message;
}

messages::IdentificationResult toMessage(const Estimate& estimate, const ResultContext& context) {
  messages::IdentificationResult message;
  message.header.stamp = stampOf(context);
  message.sequence = context.sequence;
  message.preliminary = context.preliminary;
  message.termination = toMessage(estimate.termination);
  message.message = estimate.message;
  message.log_likelihood = estimate.log_likelihood;
  message.bic = estimate.bic;
  message.seconds = estimate.seconds;
  message.nominal_model = toNominalModelMessage(estimate, context);
  message.error_model = toErrorModelMessage(estimate, context);
  message.experiment_count = static_cast<std::uint32_t>(estimate.experiment_count);
  message.window_count = static_cast<std::uint32_t>(context.window.count);
  message.window_first = context.window.first_id;
  message.window_last = context.window.last_id;
  message.window_start = toStamp(context.window.start, "the first experiment's start");
  message.window_end = toStamp(context.window.end, "the last experiment's end");
  message.fingerprint = estimate.data_fingerprint;
  message.warnings = estimate.warnings;
  message.configuration = toJson(estimate.configuration).dump();
  message.result_json = toJson(estimate).dump();
  return message;
}

}  // namespace uncertainty_identification
