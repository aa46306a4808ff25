#pragma once

#include <memory>
#include <string>

#include "own_simulation/linear_factors.h"

namespace uncertainty_identification {

/// A linear simulation that starts at rest, its input held from sample to sample: exact for a
/// continuous model and any dead time. `description` as in Simulation.
std::unique_ptr<Simulation> makeLinearSimulation(LinearFactors factors,
                                                 const std::string& description);

}  // namespace uncertainty_identification
