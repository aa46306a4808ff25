#pragma once

#include <optional>
#include <vector>

#include "own_simulation/examine.h"
#include "own_simulation/simulation_comparison.h"

namespace uncertainty_identification {

/// Curves that a simulation lacks.
struct LackingCurves {
  SimulationCauses found;
  /// With the first of them around the simulation, where it stands there and this is much better.
  std::optional<CurvedComparison> around;
  int simulations = 0;  ///< runs over one experiment
  bool ended_early = false;
};

/// Looks for curves in two ways, and takes what explains held-out data better: beside a linear
/// model of the simulation, and, where the simulation can be run again and is not linear, before
/// and behind it by running it. `own`: what was found without curves. The curves may refer to
/// `simulation`, which must outlive them.
LackingCurves searchLackingCurves(Simulation& simulation, const SimulationComparison& own,
                                  const ComparisonTask& task, const std::vector<Experiment>& fitted,
                                  const std::vector<Experiment>& held,
                                  const ExamineOptions& options);

}  // namespace uncertainty_identification
