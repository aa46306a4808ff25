#include "session/request_limits.h"

#include <algorithm>

#include "io/open_simulation.h"
#include "io/untrusted_yaml.h"
#include "session/bag_name.h"
#include "session/mebibytes.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/configuration_yaml.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

namespace {

Configuration askedConfiguration(const std::string& yaml, const Configuration& own) {
  if (yaml.empty()) return own;
  Configuration asked = parseConfiguration(loadUntrustedYaml(yaml));
  refuseSimulation(asked, "no request starts a simulation");
  asked.limits.max_experiments = std::min(asked.limits.max_experiments, own.limits.max_experiments);
  asked.limits.max_samples = std::min(asked.limits.max_samples, own.limits.max_samples);
  asked.limits.max_bag_size = std::min(asked.limits.max_bag_size, own.limits.max_bag_size);
  asked.limits.max_request_time =
      std::min(asked.limits.max_request_time, own.limits.max_request_time);
  asked.estimation.threads = own.estimation.threads;  // does not change the result
  return asked;
}

/// The orders as a message tells them, e.g. "nb 50, na 50, nc 1, nd 1".
std::string ordersOf(const NominalModelOptions& o) {
  if (o.structure == Structure::continuous)
    return "time_constants " + std::to_string(o.time_constants) + ", resonances " +
           std::to_string(o.resonances) + ", zeros " + std::to_string(o.zeros);
  if (o.structure == Structure::modal)
    return "time_constants " + std::to_string(o.time_constants) + ", resonances " +
           std::to_string(o.resonances);
  return "nb " + std::to_string(o.nb) + ", na " + std::to_string(o.na) + ", nc " +
         std::to_string(o.nc) + ", nd " + std::to_string(o.nd);
}

}  // namespace

double requestTime(double asked, const LimitOptions& limits) {
  return asked > 0 ? std::min(asked, limits.max_request_time) : limits.max_request_time;
}

Configuration requestedConfiguration(const std::string& yaml, const Configuration& own) {
  Configuration asked = askedConfiguration(yaml, own);
  asked.estimation.time_limit = requestTime(asked.estimation.time_limit, asked.limits);
  asked.explanation.time_limit = requestTime(asked.explanation.time_limit, asked.limits);
  return asked;
}

void requireEnoughSamples(const Configuration& configuration,
                          const std::vector<Experiment>& experiments) {
  constexpr long kSamplesPerParameter = 10;
  const NominalModelOptions& nominal = configuration.nominal_model;
  if (nominal.orders_auto || experiments.empty()) return;
  long samples = 0;
  for (const Experiment& experiment : experiments) samples += experiment.validSamples();
  const long parameters =
      makeNominalModel(nominal, experiments.front().sample_time)->parameterCount();
  const long needed = kSamplesPerParameter * parameters;
  if (samples >= needed) return;
  throw DataError("the nominal model has " + std::to_string(parameters) + " parameters (" +
                  ordersOf(nominal) + "), but the " + std::to_string(experiments.size()) +
                  " experiments have only " + std::to_string(samples) +
                  " measured samples; a node estimates from at least " +
                  std::to_string(kSamplesPerParameter) + " samples for each parameter, here " +
                  std::to_string(needed) + ": lower the orders, or record more");
}

std::vector<std::string> requestedBags(
    const std::vector<std::string>& names, const std::string& directory, const LimitOptions& limits,
    const std::function<std::uint64_t(const std::string& path)>& unpacked_size) {
  std::vector<std::string> paths;
  const std::uint64_t max_bytes = mebibytes(limits.max_bag_size);
  std::uint64_t unpacked = 0;
  for (const auto& name : names) {
    paths.push_back(resolveBagName(directory, name, max_bytes));
    unpacked += unpacked_size(paths.back());
    if (unpacked > max_bytes)
      throw RefusedError("bag '" + name + "': the bags of the request unpack to more than " +
                         std::to_string(limits.max_bag_size) +
                         " MiB (limits.max_bag_size); ask for fewer, or read them with identify");
  }
  return paths;
}

}  // namespace uncertainty_identification
