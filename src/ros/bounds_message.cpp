#include "ros/bounds_message.h"

#include <string>

#include "ros/answer.h"
#include "ros/number_list.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

void append(const Eigen::VectorXd& values, std::vector<double>* list) {
  list->insert(list->end(), values.data(), values.data() + values.size());
}

/// The lower limits of all levels, one row per level.
std::vector<double> lower(const std::vector<Band>& bands) {
  std::vector<double> list;
  for (const Band& band : bands) append(band.lower, &list);
  return list;
}

std::vector<double> upper(const std::vector<Band>& bands) {
  std::vector<double> list;
  for (const Band& band : bands) append(band.upper, &list);
  return list;
}

/// The bands that include the estimation errors if they are known, otherwise those of the mixture.
const Bands& widest(const UncertaintyBands& bands) {
  return bands.total.empty() ? bands.mixture : bands.total;
}

void fill(const FrequencyBounds& bounds, messages::UncertaintyBounds* message) {
  message->omega = toList(bounds.omega);
  message->magnitude = toList(bounds.magnitude);
  message->phase = toList(bounds.phase);
  const Bands& magnitude = widest(bounds.magnitude_bands);
  message->magnitude_lower = lower(magnitude.pointwise);
  message->magnitude_upper = upper(magnitude.pointwise);
  message->magnitude_lower_simultaneous = lower(magnitude.simultaneous);
  message->magnitude_upper_simultaneous = upper(magnitude.simultaneous);
  message->phase_lower = lower(widest(bounds.phase_bands).pointwise);
  message->phase_upper = upper(widest(bounds.phase_bands).pointwise);
  message->relative_error = upper(widest(bounds.relative_error).pointwise);
  message->relative_error_simultaneous = upper(widest(bounds.relative_error).simultaneous);
}

void fill(const UncertaintyWeight& weight, messages::UncertaintyBounds* message) {
  message->weight_level = weight.level;
  message->weight_level_held = weight.level_held;
  message->weight_num = toList(weight.num);
  message->weight_den = toList(weight.den);
  message->weight_continuous_num = toList(weight.continuous_num);
  message->weight_continuous_den = toList(weight.continuous_den);
  message->weight_over_bounding = weight.over_bounding_median;
  message->weight_margin = weight.margin;
}

messages::SampleModels::Response drawnPlants(const messages::SampleModels::Request& request,
                                             const Estimate& estimate) {
  using Request = messages::SampleModels::Request;
  const auto uncertainty =
      request.uncertainty == Request::TOTAL ? Uncertainty::total : Uncertainty::mixture;
  const PlantSamples drawn =
      PlantDistribution(estimate).draw(static_cast<int>(request.count), uncertainty, request.seed);
  const TransferFunctions all = transferFunctions(drawn);
  messages::SampleModels::Response response;
  response.sample_time = drawn.sample_time;
  response.delay = static_cast<std::uint32_t>(drawn.delay);
  response.numerator_size = static_cast<std::uint32_t>(all.num.cols());
  response.denominator_size = static_cast<std::uint32_t>(all.den.cols());
  response.taps = static_cast<std::uint32_t>(drawn.eta.cols());
  response.num = toRowMajor(all.num);
  response.den = toRowMajor(all.den);
  response.eta = toRowMajor(drawn.eta);
  return response;
}

}  // namespace

messages::UncertaintyBounds toMessage(const Bounds& bounds, const ResultContext& context) {
  messages::UncertaintyBounds message;
  message.header.stamp = stampOf(context);
  message.sequence = context.sequence;
  message.estimation_errors_included = !bounds.frequency.magnitude_bands.total.empty();
  message.samples = static_cast<std::uint32_t>(bounds.samples);
  message.levels = bounds.levels;
  fill(bounds.frequency, &message);
  message.time = toList(bounds.step.time);
  message.step = toList(bounds.step.nominal);
  message.step_lower = lower(widest(bounds.step.bands).pointwise);
  message.step_upper = upper(widest(bounds.step.bands).pointwise);
  if (bounds.weight) fill(*bounds.weight, &message);
  message.warnings = bounds.warnings;
  message.trusted = bounds.trust.trusted;
  message.reasons = bounds.trust.reasons;
  message.seconds = bounds.seconds;
  return message;
}

messages::SampleModels::Response answerSampleModels(const messages::SampleModels::Request& request,
                                                    const Estimate* estimate,
                                                    std::uint32_t sequence) {
  using messages::SampleModels;
  using Response = SampleModels::Response;
  constexpr std::uint32_t kMaxCount = 10000;
  if (estimate == nullptr)
    return answerOf<Response>(Response::NONE_YET, "there is no result yet to draw from");
  if (request.count < 1 || request.count > kMaxCount) {
    return answerOf<Response>(Response::REQUEST_ERROR,
                              "count: found " + std::to_string(request.count) + "; allowed: 1 to " +
                                  std::to_string(kMaxCount));
  }
  if (request.uncertainty > SampleModels::Request::TOTAL) {
    return answerOf<Response>(Response::REQUEST_ERROR, "uncertainty: found " +
                                                           std::to_string(request.uncertainty) +
                                                           "; allowed: MIXTURE (0) or TOTAL (1)");
  }
  try {
    auto response = drawnPlants(request, *estimate);
    response.sequence = sequence;
    return response;
  } catch (const DataError& error) {
    return answerOf<Response>(Response::DATA_ERROR, error.what());
  }
}

}  // namespace uncertainty_identification
