#include "data/experiment_checks.h"
#include "data/thinning.h"
#include "estimation/linearisation.h"
#include "estimation/simulation_fit.h"
#include "identification/steps.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

Validation validate(const Problem& problem, const FittedModel& fitted, InitialState asked,
                    const std::vector<Experiment>& experiments, Journal* journal) {
  Validation validation;
  if (experiments.empty()) return validation;
  const Configuration& configuration = problem.configuration;
  const int thinning = problem.data.thinning;
  const CheckReport checked =
      checkExperiments(experiments, configuration.limits, {}, problem.data.sampleTime() / thinning,
                       problem.data.experiments);
  for (const RejectedExperiment& rejected : checked.rejected)
    journal->warnings.push_back("validation: " + rejected.reason);
  std::vector<Experiment> used;
  for (int r : checked.usable) used.push_back(experiments[static_cast<std::size_t>(r)]);
  used = thinned(std::move(used), thinning);
  if (used.empty())
    throw DataError("no usable experiment is left for validation:" + reasonsOf(checked.rejected));
  for (const Experiment& experiment : used) validation.experiments.push_back(experiment.id);
  const ModelParameters& point = fitted.optimum.point;
  const NominalModel& nominal = fitted.model->nominal();
  const auto fitFrom = [&](InitialState start) {
    EstimationOptions options = configuration.estimation;
    options.initial_state = start;
    return simulationFit(nominal, point.parameters.head(nominal.parameterCount()),
                         offsetOf(problem, *fitted.model, point), options, used);
  };
  const bool at_rest = asked == InitialState::zero;
  const SimulationFit fit = fitFrom(at_rest ? InitialState::zero : InitialState::estimate);
  validation.simulation_fit_percent = fit.percent;
  validation.simulation_fit_percent_pooled = fit.pooled;
  validation.at_rest_fit_percent_pooled = fitFrom(InitialState::zero).pooled;
  const std::vector<Block> blocks = makeBlocks(used);
  const int count = static_cast<int>(used.size()), threads = threadsOf(configuration.estimation);
  Problem own = problem;
  own.configuration.estimation.initial_state = asked;
  const std::unique_ptr<LinearModel> model = buildModel(own);
  const auto about =
      linearisedAtPosteriorMeans(*model, blocks, count, threads, point, &journal->passes);
  const Likelihood likelihood(about ? *about->model : *model, blocks, count, threads);
  const Statistics statistics = likelihood.statistics(point.parameters, false);
  validation.log_density_per_experiment = likelihood.expect(statistics, point).total() / count;
  return validation;
}

}  // namespace uncertainty_identification
