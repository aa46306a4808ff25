#include "ros/reconfiguration.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/untrusted_yaml.h"
#include "ros/bag_name.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/configuration_yaml.h"

namespace uncertainty_identification {
namespace {

using Response = messages::Configure::Response;

/// What the recorder listens to, and the folders that no request may change.
constexpr const char* kFixed[] = {
    "input",         "output",           "covariates",         "experiment",
    "bag_directory", "report_directory", "report_each_result", "store_directory"};

YAML::Node parse(const std::string& text) {
  const YAML::Node tree = loadUntrustedYaml(text);
  if (tree.IsMap()) return tree;
  throw ConfigurationError(
      "configuration: found no keys; give e.g. {nominal_model: {orders: auto}}");
}

/// Limits that requests may lower only: they bound what the node takes of the machine.
constexpr const char* kBounding[] = {"max_experiments", "max_samples", "max_request_size",
                                     "max_bag_size", "max_saved_files"};

void requireWithin(const nlohmann::json& limits, const nlohmann::json& started) {
  for (const char* key : kBounding) {
    if (limits[key] <= started[key]) continue;
    throw RefusedError(std::string("limits.") + key + ": found " + limits[key].dump() +
                       ", but the node was started with " + started[key].dump() +
                       ", which no request raises; set the parameter and start the node again");
  }
}

/// The configuration asked for; what is fixed and left out is as in `current`, and so are limits
/// that are left out.
Configuration wantedConfiguration(const std::string& text, const Configuration& current,
                                  const LimitOptions& started) {
  YAML::Node tree = parse(text);
  nlohmann::json own = toJson(current);
  nlohmann::json asked = toJson(parseConfiguration(tree));
  for (auto& [key, value] : asked["limits"].items())
    if (!tree["limits"] || !tree["limits"][key]) value = own["limits"][key];
  Configuration at_start = current;
  at_start.limits = started;
  requireWithin(asked["limits"], toJson(at_start)["limits"]);
  for (const char* key : kFixed) {
    if (tree[key] && asked[key] != own[key]) {
      throw RefusedError(std::string(key) + ": found " + asked[key].dump() + ", but it is " +
                         own[key].dump() +
                         " while the node runs; leave it out, or set the parameter and start the "
                         "node again");
    }
  }
  for (const auto& [key, value] : asked.items()) {
    if (std::find(std::begin(kFixed), std::end(kFixed), key) == std::end(kFixed)) own[key] = value;
  }
  return configurationFromJson(own);
}

Response answerOf(std::uint8_t code, const std::string& message) {
  Response response;
  response.code = code;
  response.message = message;
  return response;
}

}  // namespace

Configuration configurationAtStart(const Configuration& parameters,
                                   const std::optional<StoredConfiguration>& stored) {
  return stored && toJson(stored->parameters) == toJson(parameters) ? stored->configuration
                                                                    : parameters;
}

Reconfiguration::Reconfiguration(const Configuration& parameters, const Configuration& current,
                                 IdentificationWorker& worker,
                                 std::function<void(const StoredConfiguration&)> keep)
    : parameters_(parameters), worker_(worker), keep_(std::move(keep)), current_(current) {}

Configuration Reconfiguration::current() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return current_;
}

Response Reconfiguration::answer(const messages::Configure::Request& request,
                                 const std::function<bool()>& keep_going) {
  try {
    return configure(wantedConfiguration(request.configuration, current(), parameters_.limits),
                     keep_going);
  } catch (const RefusedError& error) {
    return answerOf(Response::REFUSED, error.what());
  } catch (const ConfigurationError& error) {
    return answerOf(Response::CONFIGURATION_ERROR, error.what());
  } catch (const DataError& error) {
    return answerOf(Response::DATA_ERROR, error.what());
  } catch (const std::exception& error) {
    return answerOf(Response::INTERNAL_ERROR, std::string("internal error: ") + error.what());
  }
}

Response Reconfiguration::configure(const Configuration& wanted,
                                    const std::function<bool()>& keep_going) {
  const WorkerSnapshot snapshot = worker_.snapshot();
  std::shared_ptr<const Estimate> estimate;
  if (!snapshot.experiments.empty()) {
    estimate = std::make_shared<const Estimate>(Identifier(wanted).identify(
        snapshot.experiments, {}, [&](const Progress&) { return keep_going(); }));
    if (!estimate->usable()) return answerOf(Response::NOT_USABLE, estimate->message);
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    current_ = wanted;
  }
  worker_.adopt(wanted, estimate, snapshot);
  keep_({wanted, parameters_});
  return answerOf(Response::OK, estimate ? estimate->message
                                         : "configured; there are no experiments to identify from");
}

}  // namespace uncertainty_identification
