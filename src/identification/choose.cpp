#include <algorithm>

#include "estimation/excerpt.h"
#include "estimation/selection.h"
#include "identification/steps.h"
#include "math/polynomial.h"

/// The automatic choice of the orders of Go.
namespace uncertainty_identification {

Configuration chooseOrders(const Problem& problem, Journal* journal) {
  // What a single step shows beyond two poles is the plant's nonlinearity, or noise.
  constexpr int kMostOfStep = 2;
  Configuration chosen = problem.configuration;
  if (!chosen.nominal_model.orders_auto) return chosen;
  if (problem.data.single_steps)
    chosen.nominal_model.max_order = std::min(chosen.nominal_model.max_order, kMostOfStep);
  chosen.nominal_model = selectOrders(
      chosen, problem.data.sampleTime(), problem.data.experiments, threadsOf(chosen.estimation),
      &journal->candidates,
      [journal](double share) { return journal->progress.report(Phase::orders, share); });
  chosen.nominal_model.orders_auto = false;
  return chosen;
}

void choosePlant(Problem* problem, Journal* journal) {
  const Configuration asked = problem->configuration;
  const std::size_t before = journal->candidates.size();
  const NominalModelOptions& chosen = problem->configuration.nominal_model;
  const auto choose = [&](int max_order) {
    journal->candidates.resize(before);
    problem->configuration = asked;
    problem->configuration.nominal_model.max_order = max_order;
    problem->configuration = chooseOrders(*problem, journal);
    problem->plant = fitPlant(*problem, journal);
  };
  choose(asked.nominal_model.max_order);
  if (!asked.nominal_model.orders_auto || !problem->plant) return;
  const int largest = chosen.max_order, longest = longestOf(problem->data.experiments);
  while (chosen.na > 1 && !journal->progress.searchEnds() &&
         !oscillationsDecay(problem->plant->polynomials.a, longest))
    choose(chosen.na - 1);
  problem->configuration.nominal_model.max_order = largest;
}

}  // namespace uncertainty_identification
