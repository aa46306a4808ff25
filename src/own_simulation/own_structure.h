#pragma once

#include <functional>
#include <string>
#include <vector>

#include "own_simulation/change.h"
#include "uncertainty_identification/curves/simulation_causes.h"

namespace uncertainty_identification {

/// Curves that a simulation lacks, found beside a linear model of it.
struct OwnStructure {
  SimulationCauses found;
  double linear_fit = 0;  ///< [%] of the simulation by the linear model; below 90 % none is found
};

/// Looks for curves - dead zone, saturation, friction, drift, ... - that the simulation lacks
/// beside the changes, so that what a wrong parameter does beyond a linear model is not one of
/// them, at any place before, in and behind it: what it does beyond a linear model of it is taken
/// off the measured output, and the rest is searched as that of a linear plant, whose parameters
/// are free. `held` as in examine().
OwnStructure searchStructure(const ChangedSimulation& simulation, const Changes& changes,
                             const std::vector<Experiment>& fitted,
                             const std::vector<Experiment>& held, int max_causes,
                             const std::function<bool(const std::string& doing)>& progress);

}  // namespace uncertainty_identification
