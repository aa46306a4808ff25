#include "own_simulation/lacking_curves.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "curves/explain_simulation.h"
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

/// The share of the squared error of held-out data that is left.
double shareLeft(double fit_before, double fit_after) {
  return std::pow((100 - fit_after) / std::max(100 - fit_before, 1e-9), 2);
}

/// Whether a curve around the simulation takes as much of the held-out error away as what was found
/// beside the linear model.
bool isAsGood(const LackingCurves& around, const LackingCurves& beside,
              const SimulationComparison& own) {
  constexpr double kAsGood = 1.02;
  if (!around.around) return false;
  const double error = around.around->comparison->heldError();
  if (beside.around) return error <= kAsGood * beside.around->comparison->heldError();
  return beside.found.causes.empty() ||
         error / own.heldError() <= shareLeft(beside.found.fit_before, beside.found.fit_after);
}

/// What searchLackingCurves() says where there is hardly a linear model of the simulation.
std::string skippedText(double linear_fit, bool was_tried_around) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %%", linear_fit);
  return "a linear model fits only " + std::string(text) + " of the simulation itself, so " +
         (was_tried_around ? "that curves were looked for before and behind it, but not inside it"
                           : "that no curve can be placed in it");
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
  const bool tries_around =
      inside.linear_fit < kLinear && simulation.canRerun() && !areFewSteps(fitted, held);
  LackingCurves beside, around;
  beside.found = std::move(inside.found);
  putAround(simulation, own, task, tries_around ? most / 2 : most, &beside);
  if (tries_around) {
    const int left = most - beside.simulations;
    around.found = searchCurvesAround(simulation, task, left, &around.simulations);
    around.ended_early = around.found.ended_early;
    putAround(simulation, own, task, left - around.simulations, &around);
  }
  const int simulations = beside.simulations + around.simulations;
  const bool ended_early = beside.ended_early || around.ended_early;
  LackingCurves best = std::move(isAsGood(around, beside, own) ? around : beside);
  best.simulations = simulations;
  best.ended_early = ended_early;
  if (inside.linear_fit < kLeastSurrogateFit)
    best.found.skipped = skippedText(inside.linear_fit, around.simulations > 0);
  return best;
}

}  // namespace uncertainty_identification
