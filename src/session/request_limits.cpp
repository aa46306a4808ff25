#include "session/request_limits.h"

#include <algorithm>

#include "io/open_simulation.h"
#include "io/untrusted_yaml.h"
#include "session/bag_name.h"
#include "session/mebibytes.h"
#include "uncertainty_identification/io/configuration_yaml.h"

namespace uncertainty_identification {

Configuration requestedConfiguration(const std::string& yaml, const Configuration& own) {
  if (yaml.empty()) return own;
  Configuration asked = parseConfiguration(loadUntrustedYaml(yaml));
  refuseSimulation(asked, "no request starts a simulation");
  asked.limits.max_experiments = std::min(asked.limits.max_experiments, own.limits.max_experiments);
  asked.limits.max_samples = std::min(asked.limits.max_samples, own.limits.max_samples);
  asked.limits.max_bag_size = std::min(asked.limits.max_bag_size, own.limits.max_bag_size);
  asked.estimation.threads = own.estimation.threads;  // does not change the result
  return asked;
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
