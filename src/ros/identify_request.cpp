#include "ros/identify_request.h"

#include <ros/time.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "io/printable.h"
#include "ros/answer.h"
#include "ros/message_conversions.h"
#include "ros/request.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

using Request = messages::Identify::Request;
using Response = messages::Identify::Response;

LoadedData dataOf(const Request& request, const Configuration& configuration,
                  const std::string& bag_directory, const ProgressCallback& progress) {
  const auto most = static_cast<std::size_t>(configuration.limits.max_experiments);
  if (request.experiments.size() > most)
    throw DataError("the request has " + std::to_string(request.experiments.size()) +
                    " experiments; limits.max_experiments allows " + std::to_string(most));
  LoadedData data;
  for (const auto& experiment : request.experiments) {
    try {
      data.experiments.push_back(fromMessage(experiment, configuration.limits));
    } catch (const DataError& error) {
      data.rejected.push_back({printable(experiment.id), error.what()});
    }
  }
  append(loadRequestedBags(request.bags, bag_directory, configuration, progress), data);
  return data;
}

Estimate estimateFrom(LoadedData data, const Configuration& configuration,
                      const ProgressCallback& progress) {
  Estimate estimate = Identifier(configuration).identify(data.experiments, {}, progress);
  std::move(data.rejected.begin(), data.rejected.end(), std::back_inserter(estimate.rejected));
  std::move(data.warnings.begin(), data.warnings.end(), std::back_inserter(estimate.warnings));
  return estimate;
}

std::uint8_t codeOf(const Estimate& estimate) {
  if (estimate.termination == Termination::cancelled) return Response::CANCELLED;
  return estimate.usable() ? Response::OK : Response::NOT_USABLE;
}

Response identify(const Request& request, const Configuration& own,
                  const ProgressCallback& progress) {
  const Configuration configuration = requestedConfiguration(request.configuration, own);
  LoadedData data = dataOf(request, configuration, own.bag_directory, progress);
  requireEnoughSamples(configuration, data.experiments);
  ResultContext context;
  context.stamp = ros::Time::now().toNSec();
  context.window = windowOf(data.experiments);
  const Estimate estimate = estimateFrom(std::move(data), configuration, progress);
  Response response;
  response.code = codeOf(estimate);
  response.message = estimate.message;
  if (response.code != Response::CANCELLED) response.result = toMessage(estimate, context);
  return response;
}

}  // namespace

Response answerIdentify(const Request& request, const Configuration& own,
                        const ProgressCallback& progress) {
  return answerErrors<Response>([&] { return identify(request, own, progress); });
}

messages::IdentifyBagsResult answerIdentifyBags(const messages::IdentifyBagsGoal& goal,
                                                const Configuration& own,
                                                const ProgressCallback& progress) {
  Request request;
  request.bags = goal.bags;
  request.configuration = goal.configuration;
  Response response = answerIdentify(request, own, progress);
  messages::IdentifyBagsResult result;
  result.code = response.code;
  result.message = std::move(response.message);
  result.result = std::move(response.result);
  return result;
}

}  // namespace uncertainty_identification
