#include "estimation/selection.h"
#include "identification/steps.h"

/// The automatic choice of the orders of Go.
namespace uncertainty_identification {

Configuration chooseOrders(const Problem& problem, Journal* journal) {
  Configuration chosen = problem.configuration;
  if (!chosen.nominal_model.orders_auto) return chosen;
  chosen.nominal_model = selectOrders(
      problem.configuration, problem.data.sampleTime(), problem.data.experiments,
      threadsOf(chosen.estimation), &journal->candidates,
      [journal](double share) { return journal->progress.report(Phase::orders, share); });
  chosen.nominal_model.orders_auto = false;
  return chosen;
}

}  // namespace uncertainty_identification
