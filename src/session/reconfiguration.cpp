#include "session/reconfiguration.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/open_simulation.h"
#include "io/untrusted_yaml.h"
#include "session/refused_error.h"
#include "session/request_limits.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/configuration_yaml.h"

namespace uncertainty_identification {
namespace {

/// Keys that cannot change while the node runs: the recorder's topics, the node's folders and page.
constexpr const char* kFixed[] = {
    "input",         "output",           "covariates",         "experiment",
    "bag_directory", "report_directory", "report_each_result", "store_directory",
    "live_page"};

YAML::Node parse(const std::string& text) {
  const YAML::Node tree = loadUntrustedYaml(text);
  if (tree.IsMap()) return tree;
  throw ConfigurationError(
      "configuration: found no keys; give e.g. {nominal_model: {orders: auto}}");
}

/// Limits that requests may lower but not raise, because they bound the node's memory and disk.
constexpr const char* kBounding[] = {"max_experiments", "max_samples",     "max_request_size",
                                     "max_bag_size",    "max_saved_files", "max_request_time"};

void requireWithin(const nlohmann::json& limits, const nlohmann::json& started) {
  for (const char* key : kBounding) {
    if (limits[key] <= started[key]) continue;
    throw RefusedError(std::string("limits.") + key + ": found " + limits[key].dump() +
                       ", but the node was started with " + started[key].dump() +
                       ", which no request raises; set the parameter and start the node again");
  }
}

/// The configuration that the text asks for. Fixed keys and limits that the text leaves out are
/// taken from `current`. `started` are the limits that the node was started with.
Configuration wantedConfiguration(const std::string& text, const Configuration& current,
                                  const LimitOptions& started) {
  YAML::Node tree = parse(text);
  nlohmann::json own = toJson(current);
  const Configuration parsed = parseConfiguration(tree);
  refuseSimulation(parsed, "no request starts a simulation");
  nlohmann::json asked = toJson(parsed);
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

/// The estimate, within the time of a request. Throws DataError.
std::shared_ptr<const Estimate> identified(const Configuration& wanted,
                                           const std::vector<Experiment>& experiments,
                                           const std::function<bool()>& keep_going) {
  requireEnoughSamples(wanted, experiments);
  Configuration limited = wanted;
  limited.estimation.time_limit = requestTime(wanted.estimation.time_limit, wanted.limits);
  auto estimate = std::make_shared<Estimate>(
      Identifier(limited).identify(experiments, {}, [&](const Progress&) { return keep_going(); }));
  estimate->configuration.estimation.time_limit = wanted.estimation.time_limit;
  return estimate;
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

Reconfiguration::Outcome Reconfiguration::configure(const std::string& yaml,
                                                    const std::function<bool()>& keep_going) {
  const Configuration wanted = wantedConfiguration(yaml, current(), parameters_.limits);
  const WorkerSnapshot snapshot = worker_.snapshot();
  std::shared_ptr<const Estimate> estimate;
  if (!snapshot.experiments.empty()) {
    estimate = identified(wanted, snapshot.experiments, keep_going);
    // What takes too long now would do so again after each experiment.
    if (!estimate->usable() || estimate->termination == Termination::time_limit)
      return {false, estimate->message};
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    current_ = wanted;
  }
  worker_.adopt(wanted, estimate, snapshot);
  keep_({wanted, parameters_});
  return {true,
          estimate ? estimate->message : "configured; there are no experiments to identify from"};
}

}  // namespace uncertainty_identification
