#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"

/// What a request to identify or explain may ask of a node.
namespace uncertainty_identification {

/// The configuration that a request asks for: its YAML text, or the node's own configuration when
/// the text is empty. Limits that protect the node are never above the node's own, and the time
/// limits of estimation and explanation are at most limits.max_request_time. Throws
/// ConfigurationError.
Configuration requestedConfiguration(const std::string& yaml, const Configuration& own);

/// The time [s] that a request may take which asks for `asked` (0: for no limit).
double requestTime(double asked, const LimitOptions& limits);

/// Throws DataError when the orders of the nominal model are given and the experiments have fewer
/// than ten measured samples for each of its parameters.
void requireEnoughSamples(const Configuration& configuration,
                          const std::vector<Experiment>& experiments);

/// The paths of the bags that a request names relative to `directory`. `unpacked_size` gives the
/// size [bytes] of a bag after decompression. Throws RefusedError when a name is not allowed
/// (resolveBagName), or the bags have more than limits.max_bag_size together; FileError when there
/// is no such bag.
std::vector<std::string> requestedBags(
    const std::vector<std::string>& names, const std::string& directory, const LimitOptions& limits,
    const std::function<std::uint64_t(const std::string& path)>& unpacked_size);

}  // namespace uncertainty_identification
