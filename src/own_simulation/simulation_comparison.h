#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "own_simulation/change_search.h"
#include "uncertainty_identification/curves/simulation_causes.h"
#include "uncertainty_identification/own_simulation/extension.h"

namespace uncertainty_identification {

/// What a simulation is compared with, and how.
struct ComparisonTask {
  ComparedData fitted, held;
  ChangeSearchLimits limits;
  int most = 0;                         ///< runs over one experiment
  std::function<bool(int)> keep_going;  ///< as in SimulationRuns

  /// Runs that a comparison needs at least: one over each experiment.
  int fewest() const { return static_cast<int>(fitted.runs.size() + held.runs.size()); }
};

/// A simulation and the changes that it asks for.
struct SimulationComparison {
  SimulationRuns runs;
  ChangedSimulation changed;
  ChangeSearchResult result;

  /// `most`: runs in all. The task and the simulation must outlive it.
  SimulationComparison(Simulation& simulation, const ComparisonTask& task, int most);

  /// The same search with so many runs in all: what it has run is kept.
  void goOn(const ComparisonTask& task, int most);

  double heldError() const { return result.held_after.sum(); }
};

/// The same with a curve around the simulation.
struct CurvedComparison {
  OwnCurve curve;
  std::unique_ptr<Simulation> simulation;
  std::unique_ptr<SimulationComparison> comparison;  ///< null: there were too few runs left for it
  int simulations = 0;

  bool endedEarly() const { return !comparison || comparison->runs.endedEarly(); }
};

/// The comparison with the curve of a cause around the simulation, which must outlive it. Nothing
/// where the cause acts elsewhere, or the simulation cannot be run with another input.
std::optional<CurvedComparison> compareWithCurve(Simulation& simulation,
                                                 const SimulationCause& cause,
                                                 const ComparisonTask& task, int most);

}  // namespace uncertainty_identification
