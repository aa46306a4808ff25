#pragma once

#include <string>
#include <vector>

#include "session/request_limits.h"
#include "uncertainty_identification/data/loaded_data.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// Reads the bags that a request names relative to `directory`; without names the result is empty.
/// While reading, `progress` is called with the phase "reading bags"; when it returns false, the
/// reading is cancelled. Throws RefusedError, FileError, CancelledError.
LoadedData loadRequestedBags(const std::vector<std::string>& names, const std::string& directory,
                             const Configuration& configuration, const ProgressCallback& progress);

}  // namespace uncertainty_identification
