#include "ros/request.h"

#include <limits>

#include "uncertainty_identification/ros/load_data.h"

namespace uncertainty_identification {

LoadedData loadRequestedBags(const std::vector<std::string>& names, const std::string& directory,
                             const Configuration& configuration, const ProgressCallback& progress) {
  if (names.empty()) return {};
  const auto paths = requestedBags(names, directory, configuration.limits, unpackedSize);
  const Progress reading{"reading bags", 0, std::numeric_limits<double>::quiet_NaN()};
  return loadData(paths, configuration, [&] { return progress(reading); });
}

}  // namespace uncertainty_identification
