#include "own_simulation/simulation_comparison.h"

#include "own_simulation/surrounding_curve.h"

namespace uncertainty_identification {

SimulationComparison::SimulationComparison(Simulation& simulation, const ComparisonTask& task,
                                           int most)
    : runs(simulation, most, task.keep_going),
      changed(runs, task.fitted),
      result(searchChanges(changed, task.fitted, task.held, task.limits)) {}

void SimulationComparison::goOn(const ComparisonTask& task, int most) {
  runs.allow(most);
  result = searchChanges(changed, task.fitted, task.held, task.limits);
}

std::optional<CurvedComparison> compareWithCurve(Simulation& simulation,
                                                 const SimulationCause& cause,
                                                 const ComparisonTask& task, int most) {
  const std::optional<SurroundingCurve> around = surroundingCurve(cause);
  if (!around || (around->curve.of != "output" && !simulation.canRerun())) return std::nullopt;
  CurvedComparison curved;
  curved.curve = around->curve;
  if (!around->is_to_scale && most >= 2 * task.fewest())
    curved.curve = scaledTo(simulation, around->curve, task.fitted, most - task.fewest(),
                            task.keep_going, &curved.simulations);
  if (most - curved.simulations < task.fewest()) return curved;
  curved.simulation = withCurve(simulation, curved.curve);
  curved.comparison =
      std::make_unique<SimulationComparison>(*curved.simulation, task, most - curved.simulations);
  curved.simulations += curved.comparison->runs.count();
  return curved;
}

}  // namespace uncertainty_identification
