#pragma once

#include "own_simulation/simulation_comparison.h"

namespace uncertainty_identification {

/// Looks for a curve before or behind a simulation that can be run again and is not linear, by
/// running it with the curve: a dead zone, a limit, another gain for one sign, a square and a cubic
/// of the input or of the output, and a gain that drifts over the experiment. A gain and an offset
/// of the output are free beside it. At most one is named, with those that the data cannot tell
/// from it. Needs at most `most` runs, the number of which is added to `count`. Curves inside the
/// simulation are not looked for.
SimulationCauses searchCurvesAround(Simulation& simulation, const ComparisonTask& task, int most,
                                    int* count);

}  // namespace uncertainty_identification
