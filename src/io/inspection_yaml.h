#pragma once

#include <string>

#include "inspection/inspected_data.h"

namespace uncertainty_identification {

/// A configuration with comments that reads the inspected data as they were inspected. Throws
/// DataError where nothing could be chosen, where no experiment could be read with it, or for a
/// name that YAML cannot hold; the message says what to do.
std::string inspectionYaml(const InspectedData& data);

}  // namespace uncertainty_identification
