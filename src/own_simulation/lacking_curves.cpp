#include "own_simulation/lacking_curves.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "own_simulation/curves_around.h"
#include "own_simulation/linear_surrogate.h"
#include "own_simulation/own_structure.h"

namespace uncertainty_identification {
namespace {

/// The changes of parameters.
Changes parametersAmong(Changes changes) {
  changes.erase(
      std::remove_if(changes.begin(), changes.end(),
                     [](const Change& each) { return each.kind != ChangeKind::parameter; }),
      changes.end());
  return changes;
}

std::string skippedText(double linear_fit, bool can_rerun) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %%", linear_fit);
  return "a linear model fits only " + std::string(text) + " of the simulation itself, so " +
         (can_rerun ? "that curves were looked for before and behind it, but not inside it"
                    : "that no curve can be placed in it");
}

/// Puts the first curve around the simulation, if that is much better than without it.
void putAround(Simulation& simulation, const SimulationComparison& own, const ComparisonTask& task,
               int most, LackingCurves* curves) {
  constexpr double kBetter = 0.9;  // squared error with the curve, over that without it
  if (curves->found.causes.empty()) return;
  curves->around = compareWithCurve(simulation, curves->found.causes.front(), task, most);
  if (!curves->around) return;
  curves->simulations += curves->around->simulations;
  curves->ended_early = curves->ended_early || curves->around->endedEarly();
  const bool is_better = curves->around->comparison &&
                         curves->around->comparison->heldError() < kBetter * own.heldError();
  if (!is_better) curves->around.reset();
}

/// Whether a curve around the simulation explains held-out data at least as well as what was found
/// beside the linear model.
bool isAsGood(const LackingCurves& around, const LackingCurves& beside,
              const ComparisonTask& task) {
  constexpr double kAsGood = 1.02;
  if (!around.around) return false;
  const double error = around.around->comparison->heldError();
  if (beside.around) return error <= kAsGood * beside.around->comparison->heldError();
  return beside.found.causes.empty() || task.held.fitOf(error) >= beside.found.fit_after;
}

}  // namespace

LackingCurves searchLackingCurves(Simulation& simulation, const SimulationComparison& own,
                                  const ComparisonTask& task, const std::vector<Experiment>& fitted,
                                  const std::vector<Experiment>& held,
                                  const ExamineOptions& options) {
  constexpr double kLinear = 98;  // [%] of a simulation by its linear model, which then suffices
  const int most = task.most - own.runs.count();
  OwnStructure inside = searchStructure(own.changed, parametersAmong(own.result.fit.changes),
                                        fitted, held, options.max_causes, options.progress);
  LackingCurves beside;
  beside.found = std::move(inside.found);
  putAround(simulation, own, task, most, &beside);
  LackingCurves around;
  if (inside.linear_fit < kLinear && simulation.canRerun()) {
    around.found =
        searchCurvesAround(simulation, task, most - beside.simulations, &around.simulations);
    around.ended_early = around.found.ended_early;
    putAround(simulation, own, task, most - beside.simulations - around.simulations, &around);
  }
  const int simulations = beside.simulations + around.simulations;
  const bool ended_early = beside.ended_early || around.ended_early;
  LackingCurves best = std::move(isAsGood(around, beside, task) ? around : beside);
  best.simulations = simulations;
  best.ended_early = ended_early;
  if (inside.linear_fit < kLeastSurrogateFit)
    best.found.skipped = skippedText(inside.linear_fit, simulation.canRerun());
  return best;
}

}  // namespace uncertainty_identification
