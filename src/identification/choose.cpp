#include <algorithm>

#include "configuration/thread_count.h"
#include "estimation/excerpt.h"
#include "estimation/selection.h"
#include "identification/lasting_oscillations.h"
#include "identification/steps.h"
#include "math/polynomial.h"

/// The automatic choice of the orders of Go.
namespace uncertainty_identification {

Configuration chooseOrders(const Problem& problem, Journal* journal) {
  // What a single step shows beyond two poles is the plant's nonlinearity, or noise.
  constexpr int kMostOfStep = 2;
  // With fewer samples for each coefficient of A and B, further poles describe the noise.
  constexpr long kSamplesEach = 20, kAlways = 2;
  Configuration chosen = problem.configuration;
  if (!chosen.nominal_model.orders_auto) return chosen;
  const long most = std::max(kAlways, problem.data.validSamples() / (2 * kSamplesEach));
  chosen.nominal_model.max_order =
      static_cast<int>(std::min<long>(chosen.nominal_model.max_order, most));
  if (problem.data.single_steps)
    chosen.nominal_model.max_order = std::min(chosen.nominal_model.max_order, kMostOfStep);
  chosen.nominal_model = selectOrders(
      chosen, problem.data.sampleTime(), problem.data.experiments,
      threadCount(chosen.estimation.threads), &journal->candidates,
      [journal](double share) { return journal->progress.report(Phase::orders, share); });
  chosen.nominal_model.orders_auto = false;
  return chosen;
}

namespace {

/// Orders of Go, the plant fitted to its simulation, and what was compared for them.
struct PlantChoice {
  Configuration configuration;
  std::optional<FittedPlant> plant;
  std::vector<Candidate> candidates;
};

PlantChoice chooseUpTo(int max_order, Problem problem, const std::vector<Candidate>& before,
                       Journal* journal) {
  const int asked = problem.configuration.nominal_model.max_order;
  problem.configuration.nominal_model.max_order = max_order;
  journal->candidates = before;
  problem.configuration = chooseOrders(problem, journal);
  std::optional<FittedPlant> plant = fitPlant(problem, journal);
  problem.configuration.nominal_model.max_order = asked;
  return {problem.configuration, std::move(plant), journal->candidates};
}

/// The fit of the chosen orders to held-out data [%]; none where there is none.
std::optional<double> heldOutFit(const PlantChoice& choice) {
  for (const Candidate& each : choice.candidates)
    if (each.choice == "orders" && each.chosen) return each.validation_fit;
  return {};
}

/// Whether the oscillations of a plant are its own: the input excites them, and without them it
/// simulates held-out data far worse.
bool isWorthItsOscillations(const Problem& problem, const PlantChoice& plant,
                            const PlantChoice& smaller) {
  constexpr double kFarWorse = 5;  // [% of fit]
  return !hasUnexcitedOscillation(plant.plant->polynomials, plant.plant->offset,
                                  problem.data.experiments) &&
         heldOutFit(smaller) < heldOutFit(plant).value_or(0) - kFarWorse;
}

}  // namespace

void choosePlant(Problem* problem, Journal* journal) {
  const std::vector<Candidate> before = journal->candidates;
  const NominalModelOptions asked = problem->configuration.nominal_model;
  const int longest = longestOf(problem->data.experiments);
  PlantChoice best = chooseUpTo(asked.max_order, *problem, before, journal);
  while (asked.orders_auto && best.plant && best.configuration.nominal_model.na > 1 &&
         !journal->progress.searchEnds() &&
         !oscillationsDecay(best.plant->polynomials.a, longest)) {
    const int fewer = best.configuration.nominal_model.na - 1;
    PlantChoice smaller = chooseUpTo(fewer, *problem, before, journal);
    if (isWorthItsOscillations(*problem, best, smaller)) break;
    best = std::move(smaller);
  }
  problem->configuration = best.configuration;
  problem->plant = best.plant;
  journal->candidates = best.candidates;
}

}  // namespace uncertainty_identification
