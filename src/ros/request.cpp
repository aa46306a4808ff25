#include "ros/request.h"

#include <algorithm>
#include <limits>

#include "io/untrusted_yaml.h"
#include "ros/bag_name.h"
#include "ros/mebibytes.h"
#include "uncertainty_identification/io/configuration_yaml.h"
#include "uncertainty_identification/ros/load_data.h"

namespace uncertainty_identification {

Configuration requestedConfiguration(const std::string& yaml, const Configuration& own) {
  if (yaml.empty()) return own;
  Configuration asked = parseConfiguration(loadUntrustedYaml(yaml));
  asked.limits.max_experiments = std::min(asked.limits.max_experiments, own.limits.max_experiments);
  asked.limits.max_samples = std::min(asked.limits.max_samples, own.limits.max_samples);
  asked.limits.max_bag_size = std::min(asked.limits.max_bag_size, own.limits.max_bag_size);
  asked.estimation.threads = own.estimation.threads;  // which never changes a result
  return asked;
}

LoadedData loadRequestedBags(const std::vector<std::string>& names, const std::string& directory,
                             const Configuration& configuration, const ProgressCallback& progress) {
  if (names.empty()) return {};
  std::vector<std::string> paths;
  const std::uint64_t most = mebibytes(configuration.limits.max_bag_size);
  std::uint64_t unpacked = 0;
  for (const auto& name : names) {
    paths.push_back(resolveBagName(directory, name, most));
    unpacked += unpackedSize(paths.back());
    if (unpacked > most)
      throw RefusedError("bag '" + name + "': the bags of the request unpack to more than " +
                         std::to_string(configuration.limits.max_bag_size) +
                         " MiB (limits.max_bag_size); ask for fewer, or read them with identify");
  }
  const Progress reading{"reading bags", 0, std::numeric_limits<double>::quiet_NaN()};
  return loadData(paths, configuration, [&] { return progress(reading); });
}

}  // namespace uncertainty_identification
