#pragma once

#include <memory>

#include "uncertainty_identification/curves/simulation_causes.h"
#include "uncertainty_identification/own_simulation/simulation.h"

namespace uncertainty_identification {

/// The simulation, which must outlive it, with its input behind a dead zone, a limit, or both, as
/// `cause` has it. Null where the cause is another one: only these leave the gain its meaning,
/// which is that of the part of slope 1.
std::unique_ptr<Simulation> behindInputCurve(Simulation& simulation, const SimulationCause& cause);

}  // namespace uncertainty_identification
