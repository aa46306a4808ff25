#include <algorithm>

#include "estimation/excerpt.h"
#include "estimation/initial_guess.h"
#include "estimation/selection.h"
#include "identification/steps.h"
#include "math/information_criterion.h"
#include "model/fixed_plant.h"
#include "model/sensitivity.h"

/// The automatic choices of orders and taps.
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

namespace {

/// Best fit of a model with a single component, with its BIC. Absent if the likelihood is not
/// finite at any start.
std::optional<Candidate> singleComponentCandidate(const Likelihood& likelihood,
                                                  const std::vector<Eigen::VectorXd>& starts,
                                                  const OptimisationOptions& options,
                                                  const std::string& choice,
                                                  const std::string& description) {
  const auto single = bestSingleComponent(likelihood, starts, options);
  if (!single) return {};
  const Statistics statistics = likelihood.statistics(single->parameters, false);
  const double reached = likelihood.expect(statistics, *single).total();
  const int parameters = likelihood.model().parameterCount() + 1;
  const int mixture = mixtureParameters(options.constraint, likelihood.model().regressors(), 1);
  const double criterion =
      bic(reached, parameters, mixture, statistics.samples().sum(), likelihood.experiments());
  return Candidate{choice, description, parameters + mixture, reached, criterion, {}, false};
}

int chooseTaps(Problem problem, Journal* journal) {
  ErrorModelOptions& options = problem.configuration.error_model;
  const int fewest = options.constraint == Constraint::zero_static_gain ? 2 : 1;
  const int most = std::max(options.max_taps, fewest);
  const std::size_t first = journal->candidates.size();
  std::vector<int> taps;  // of the candidates from `first` on
  for (options.taps = fewest; options.taps <= most; ++options.taps) {
    const std::unique_ptr<LinearModel> model = buildModel(problem);
    const std::unique_ptr<Likelihood> likelihood = likelihoodOf(problem, *model);
    const auto candidate = singleComponentCandidate(
        *likelihood, startsFromData(problem, *model),
        optimisationOptions(problem.configuration, Phase::taps, &journal->progress), "taps",
        "taps=" + std::to_string(options.taps));
    journal->passes += likelihood->passes();
    if (!candidate) continue;
    journal->candidates.push_back(*candidate);
    taps.push_back(options.taps);
  }
  const std::optional<std::size_t> least = chooseLeastBic(first, &journal->candidates);
  return least ? taps[*least - first] : fewest;
}

}  // namespace

Configuration chooseNoiseOrders(const Problem& problem, Journal* journal) {
  Configuration chosen = problem.configuration;
  ErrorModelOptions none;
  none.taps = 0;
  const FittedPlant& plant = *problem.plant;
  const std::vector<Experiment> experiments = thinned(problem.data.experiments, kEnoughSamples);
  const std::vector<Block> blocks = makeBlocks(experiments);
  const std::size_t first = journal->candidates.size();
  std::vector<int> orders;  // of the candidates from `first` on
  for (int order = 0; order <= kLargestNoiseOrder; ++order) {
    const LinearModel model(fixPlant(plant.polynomials, order, order), ErrorBasis(none),
                            chosen.estimation);
    const Likelihood likelihood(model, blocks, static_cast<int>(experiments.size()),
                                threadsOf(chosen.estimation));
    const std::string count = std::to_string(order);
    const auto candidate = singleComponentCandidate(
        likelihood, noiseStarts(model, plant.polynomials, plant.offset, experiments),
        OptimisationOptions(), "noise orders", "nc=" + count + " nd=" + count);
    if (!candidate) continue;
    journal->candidates.push_back(*candidate);
    orders.push_back(order);
    if (!journal->progress.report(Phase::noise_orders, order / (1.0 + kLargestNoiseOrder),
                                  candidate->log_likelihood))
      break;
  }
  const std::optional<std::size_t> least = chooseLeastBic(first, &journal->candidates);
  const int order = least ? orders[*least - first] : 0;
  chosen.nominal_model.structure = order == 0 ? Structure::output_error : Structure::box_jenkins;
  chosen.nominal_model.nc = chosen.nominal_model.nd = order;
  return chosen;
}

Configuration chooseErrorModel(const Problem& problem, Journal* journal) {
  Configuration chosen = problem.configuration;
  ErrorModelOptions& options = chosen.error_model;
  if (options.taps == kAutomatic && !variesParameters(options.basis))
    options.taps = chooseTaps(problem, journal);
  completeErrorModel(*remainingNominalModel(problem), &options);
  return chosen;
}

}  // namespace uncertainty_identification
