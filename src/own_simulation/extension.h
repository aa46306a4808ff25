#pragma once

#include "own_simulation/change.h"
#include "uncertainty_identification/own_simulation/extension.h"

namespace uncertainty_identification {

/// The simulation with the changes, in the units of the data. `plant`: the simulation
/// itself, or the linear model of it whose parameters stand for those that it lacks.
OwnExtension extensionOf(const ChangedSimulation& simulation, const Changes& changes,
                         double sample_time, const Simulation& plant, bool is_surrogate);

}  // namespace uncertainty_identification
