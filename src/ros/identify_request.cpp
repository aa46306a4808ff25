#include "uncertainty_identification/ros/identify_request.h"

#include <ros/time.h>

#include <algorithm>
#include <iterator>

#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"
#include "uncertainty_identification/io/configuration_yaml.h"
#include "uncertainty_identification/ros/bag_name.h"
#include "uncertainty_identification/ros/load_data.h"
#include "uncertainty_identification/ros/message_conversions.h"

namespace uncertainty_identification {
namespace {

using Request = messages::Identify::Request;
using Response = messages::Identify::Response;

Configuration configurationOf(const Request& request, const Configuration& own) {
  if (request.configuration.empty()) return own;
  try {
    return parseConfiguration(YAML::Load(request.configuration));
  } catch (const YAML::Exception& error) {
    throw ConfigurationError(std::string("configuration is no YAML: ") + error.what());
  }
}

LoadedData dataOf(const Request& request, const Configuration& configuration,
                  const std::string& bag_directory) {
  LoadedData data;
  for (const auto& experiment : request.experiments) {
    try {
      data.experiments.push_back(fromMessage(experiment));
    } catch (const DataError& error) {
      data.rejected.push_back({experiment.id, error.what()});
    }
  }
  std::vector<std::string> paths;
  for (const auto& name : request.bags) paths.push_back(resolveBagName(bag_directory, name));
  if (!paths.empty()) append(loadData(paths, configuration), data);
  return data;
}

Estimate estimateFrom(LoadedData data, const Configuration& configuration,
                      const std::function<bool()>& keep_going) {
  Estimate estimate =
      Identifier(configuration).identify(data.experiments, {}, [&keep_going](const Progress&) {
        return keep_going();
      });
  std::move(data.rejected.begin(), data.rejected.end(), std::back_inserter(estimate.rejected));
  std::move(data.warnings.begin(), data.warnings.end(), std::back_inserter(estimate.warnings));
  return estimate;
}

Response identify(const Request& request, const Configuration& own,
                  const std::function<bool()>& keep_going) {
  const Configuration configuration = configurationOf(request, own);
  LoadedData data = dataOf(request, configuration, own.bag_directory);
  ResultContext context;
  context.stamp = ros::Time::now();
  context.window = timeWindow(data.experiments);
  const Estimate estimate = estimateFrom(std::move(data), configuration, keep_going);
  Response response;
  response.code = estimate.usable() ? Response::OK : Response::NOT_USABLE;
  response.message = estimate.message;
  response.result = toMessage(estimate, context);
  return response;
}

Response failure(std::uint8_t code, const std::string& message) {
  Response response;
  response.code = code;
  response.message = message;
  return response;
}

}  // namespace

Response answerIdentify(const Request& request, const Configuration& own,
                        const std::function<bool()>& keep_going) {
  try {
    return identify(request, own, keep_going);
  } catch (const RefusedError& error) {
    return failure(Response::REFUSED, error.what());
  } catch (const ConfigurationError& error) {
    return failure(Response::CONFIGURATION_ERROR, error.what());
  } catch (const DataError& error) {
    return failure(Response::DATA_ERROR, error.what());
  } catch (const FileError& error) {
    return failure(Response::FILE_ERROR, error.what());
  } catch (const std::exception& error) {
    return failure(Response::INTERNAL_ERROR, std::string("internal error: ") + error.what());
  }
}

}  // namespace uncertainty_identification
