#include "identification/identify.h"

#include "estimation/stopwatch.h"
#include "identification/steps.h"
#include "uncertainty_identification/version.h"

namespace uncertainty_identification {

Estimate identify(const Request& request, const std::vector<Experiment>& experiments,
                  const std::vector<Experiment>& validation) {
  const Stopwatch watch;
  Journal journal{ProgressPhases(request.progress)};
  const CheckedData data = checkData(request.configuration, experiments, &journal);
  Problem problem{data, request.nominal_model, request.previous, {}, {}};
  problem.configuration = limitErrorModel(request.configuration, data.count(), &journal);
  problem.configuration = chooseOrders(problem, &journal);
  problem.plant = fitPlant(problem, &journal);
  if (problem.plant) problem.plant = describePlant(problem, &journal);
  if (problem.plant && request.configuration.nominal_model.orders_auto)
    problem.configuration = chooseNoiseOrders(problem, &journal);
  problem.configuration = chooseErrorModel(problem, &journal);
  const FittedModel fitted = fitModel(problem, &journal);
  Estimate estimate = describe(problem, fitted, &journal);
  if (journal.progress.cancelled()) {
    estimate.termination = Termination::cancelled;
    estimate.message = "cancelled";
  } else {
    estimate.validation = validate(problem, fitted, validation, &journal);
  }
  estimate.version = version();
  estimate.candidates = std::move(journal.candidates);
  estimate.warnings = std::move(journal.warnings);
  estimate.passes = journal.passes;
  estimate.seconds = watch.seconds();
  return estimate;
}

FoldModel identifyPlant(const Request& request, const std::vector<Experiment>& experiments) {
  Journal journal{ProgressPhases(request.progress)};
  const CheckedData data = checkData(request.configuration, experiments, &journal);
  Problem problem{data, request.nominal_model, request.previous, {}, {}};
  problem.configuration = limitErrorModel(request.configuration, data.count(), &journal);
  problem.plant = fitPlant(problem, &journal);
  if (!problem.plant) {
    problem.configuration = chooseErrorModel(problem, &journal);
    const FittedModel fitted = fitModel(problem, &journal);
    problem.plant = plantOf(*fitted.model, fitted.optimum.point);
  }
  const Polynomials& plant = problem.plant->polynomials;
  return {plant.delay, plant.b, plant.a, problem.plant->offset};
}

}  // namespace uncertainty_identification
