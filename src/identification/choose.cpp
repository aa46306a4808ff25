#include <algorithm>

#include "estimation/selection.h"
#include "identification/steps.h"

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

}  // namespace uncertainty_identification
