#pragma once

#include <string>

#include "own_simulation/simulation_errors.h"

namespace uncertainty_identification {

/// The errors as sentences with their 95 % intervals, and why some are not told.
std::string describe(const SimulationErrors& errors);

}  // namespace uncertainty_identification
