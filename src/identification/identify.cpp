#include "identification/identify.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "estimation/excerpt.h"
#include "estimation/stopwatch.h"
#include "identification/mean_plant.h"
#include "identification/steps.h"
#include "identification/structure_error.h"
#include "math/interruption.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/version.h"

namespace uncertainty_identification {
namespace {

/// The problem of the checked data, before anything is chosen but what their number and scale ask
/// for.
Problem problemOf(const Request& request, const CheckedData& data, Journal* journal) {
  Problem problem{data, request.nominal_model, request.previous, {}, {}, {}};
  problem.configuration = limitErrorModel(request.configuration, data.count(), journal);
  problem.configuration.estimation.thinning = data.thinning;
  problem.configuration = chooseInitialState(problem.configuration, data, journal);
  problem.configuration = chooseOffsets(problem, journal);
  problem.configuration = limitDeadTime(problem);
  return problem;
}

/// The data with the beginnings of long records in place of the whole, and of very many records a
/// part: folds need Go alone, and one fit each.
CheckedData beginnings(CheckedData data) {
  constexpr int kAlways =
      2000;  // samples of a record that are kept, however many records there are
  const int longest = std::max(kAlways, kEnoughSamples / data.count());
  data.experiments = fewerSamples(data.experiments, 10 * kEnoughSamples);
  for (Experiment& experiment : data.experiments)
    if (experiment.samples() > longest) experiment = excerpt(experiment, 0, longest);
  data.blocks = makeBlocks(data.experiments);
  return data;
}

/// Whether the orders were chosen from data, now or in the result that is continued.
bool mayLackDynamics(const Request& request) {
  return request.configuration.nominal_model.orders_auto ||
         (request.previous != nullptr && request.previous->structure_error.omega.size() > 0);
}

std::string timeLimitText(const Request& request) {
  std::ostringstream text;
  text << "the time limit of " << request.configuration.estimation.time_limit
       << " s was reached (estimation.time_limit; limits.max_request_time for a request)";
  return text.str();
}

/// Says that the search was cut short, so that this is the best model of those that were tried.
void markAsHurried(const Request& request, Optimum* optimum) {
  optimum->termination = Termination::time_limit;
  optimum->message = timeLimitText(request) + ": this is the best model that was found until then";
}

/// The result of an identification that ended without a model.
Estimate ended(const Request& request, const Journal& journal) {
  Estimate estimate;
  estimate.configuration = request.configuration;
  const bool cancelled = journal.progress.cancelled();
  estimate.termination = cancelled ? Termination::cancelled : Termination::time_limit;
  estimate.message = cancelled ? "cancelled"
                               : timeLimitText(request) +
                                     " before there was a model; lower the orders (nominal_model: "
                                     "nb, na, nc, nd), state what is chosen automatically, use "
                                     "fewer experiments, or raise the limit";
  return estimate;
}

Estimate identifyFrom(const Request& request, const std::vector<Experiment>& experiments,
                      const std::vector<Experiment>& validation, Journal* journal) {
  const CheckedData data = checkData(request.configuration, experiments, journal);
  Problem problem = problemOf(request, data, journal);
  FittedModel fitted = fitWithOffsets(request.configuration, &problem, journal);
  if (journal->progress.searchEnds()) markAsHurried(request, &fitted.optimum);
  Estimate estimate = describe(problem, fitted, journal);
  const InitialState asked = request.configuration.estimation.initial_state;
  estimate.configuration.estimation.initial_state = asked;  // other data may start elsewhere
  if (mayLackDynamics(request))
    estimate.structure_error = structureErrorOf(problem.data.experiments, estimate);
  estimate.trust = trustOfDirection(std::move(estimate.trust), data.following,
                                    estimate.nominal_model.delay, mayLackDynamics(request));
  estimate.trust = trustOfInputs(std::move(estimate.trust), data);
  estimate.trust = trustOfLength(std::move(estimate.trust), estimate.nominal_model.a,
                                 longestOf(data.experiments));
  estimate.trust = trustOfOrders(std::move(estimate.trust), journal->candidates,
                                 estimate.nominal_model.a.size(), estimate.simulation_fit_percent);
  estimate.validation = validate(problem, fitted, asked, validation, journal);
  estimate.trust = trustAfterValidation(std::move(estimate.trust), estimate.validation,
                                        estimate.simulation_fit_percent);
  return estimate;
}

}  // namespace

Estimate identify(const Request& request, const std::vector<Experiment>& experiments,
                  const std::vector<Experiment>& validation) {
  const Stopwatch watch;
  Journal journal{ProgressPhases(request.progress, request.configuration.estimation.time_limit)};
  const Interruption interruption([&] { return journal.progress.mustEnd(); });
  Estimate estimate;
  try {
    estimate = identifyFrom(request, experiments, validation, &journal);
  } catch (const CancelledError&) {
    if (!interruption.requested()) throw;  // somebody further out has cancelled
    estimate = ended(request, journal);
  }
  if (journal.progress.cancelled()) estimate = ended(request, journal);
  estimate.version = version();
  estimate.candidates = std::move(journal.candidates);
  estimate.warnings = std::move(journal.warnings);
  estimate.passes = journal.passes;
  estimate.seconds = watch.seconds();
  return estimate;
}

FoldModel identifyPlant(const Request& request, const std::vector<Experiment>& experiments) {
  constexpr int kEnough = 5;           // scoring steps from the estimate of all folds
  constexpr double kTolerance = 1e-3;  // [nats]
  Journal journal{ProgressPhases(request.progress)};
  const Interruption interruption([&] { return journal.progress.mustEnd(); });
  const CheckedData data = beginnings(checkData(request.configuration, experiments, &journal));
  Problem problem = problemOf(request, data, &journal);
  problem.plant = fitPlant(problem, &journal);
  if (!problem.plant) {
    adopt(chooseModel(problem, problem.configuration, Orders::of_simulation, &journal), &problem);
    EstimationOptions& estimation = problem.configuration.estimation;
    estimation.max_iterations = std::min(estimation.max_iterations, kEnough);
    estimation.tolerance = std::max(estimation.tolerance, kTolerance);
    const FittedModel fitted = fitModel(problem, &journal);
    problem.plant = plantOf(*fitted.model, fitted.optimum.point);
    problem.plant->polynomials = meanPlant(*fitted.model, fitted.optimum.point);
  }
  const Polynomials& plant = problem.plant->polynomials;
  return {plant.delay, plant.b, plant.a, problem.plant->offset};
}

}  // namespace uncertainty_identification
