#pragma once

#include <memory>

#include "uncertainty_identification/own_simulation/simulation.h"
#include "uncertainty_identification/own_simulation_options.h"

namespace uncertainty_identification {

/// The simulation that the program of `options` is: it is started now, once, and gets one line of
/// JSON for each run (docs/own_simulation.md). Throws ConfigurationError where it cannot be
/// started; its runs throw DataError where it crashes, hangs, or answers something else.
std::unique_ptr<Simulation> startProgramSimulation(const OwnSimulationOptions& options);

}  // namespace uncertainty_identification
