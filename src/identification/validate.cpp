#include <algorithm>

#include "configuration/thread_count.h"
#include "data/experiment_checks.h"
#include "data/stray_readings.h"
#include "data/thinning.h"
#include "data/unmeasured_start.h"
#include "estimation/linearisation.h"
#include "identification/mean_plant.h"
#include "identification/steps.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// Mean log density of the experiments, if all begin as stated.
double logDensity(Problem problem, const FittedModel& fitted, InitialState state,
                  const std::vector<Experiment>& experiments, Journal* journal) {
  problem.configuration.estimation.initial_state = state;
  const std::vector<Block> blocks = makeBlocks(experiments);
  const int count = static_cast<int>(experiments.size());
  const int threads = threadCount(problem.configuration.estimation.threads);
  const ModelParameters& point = fitted.optimum.point;
  const std::unique_ptr<LinearModel> model = buildModel(problem);
  const auto about =
      linearisedAtPosteriorMeans(*model, blocks, count, threads, point, &journal->passes);
  const Likelihood likelihood(about ? *about->model : *model, blocks, count, threads);
  const Statistics statistics = likelihood.statistics(point.parameters, false);
  return likelihood.expect(statistics, point).total() / count;
}

}  // namespace

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
  const StrayReadings stray =
      strayReadings(used, configuration.limits.max_stray, problem.data.has_strays);
  if (stray.count > 0) journal->warnings.push_back("validation: " + strayText(stray, used));
  used = without(stray, std::move(used));
  used = thinned(std::move(used), thinning);
  if (used.empty())
    throw DataError("no usable experiment is left for validation:" + reasonsOf(checked.rejected));
  for (const Experiment& experiment : used) validation.experiments.push_back(experiment.id);
  const std::vector<Experiment> whole = used;
  std::vector<std::string> remarks;
  if (mayStartAnywhere(configuration.estimation, used))
    used = fromFirstMeasured(std::move(used), &remarks);
  for (const std::string& remark : remarks) journal->warnings.push_back("validation: " + remark);
  const ModelParameters& point = fitted.optimum.point;
  const auto fitFrom = [&](InitialState start) {
    EstimationOptions options = configuration.estimation;
    options.initial_state = start;
    return meanPlantFit(*fitted.model, point, offsetOf(problem, *fitted.model, point), options,
                        start == InitialState::zero ? whole : used);
  };
  const bool at_rest = asked == InitialState::zero;
  const SimulationFit fit = fitFrom(at_rest ? InitialState::zero : InitialState::estimate);
  validation.simulation_fit_percent = fit.percent;
  const Offsets offsets = configuration.estimation.offsets;
  validation.simulation_fit_percent_pooled = fit.pooledFor(offsets);
  validation.at_rest_fit_percent_pooled = fitFrom(InitialState::zero).pooledFor(offsets);
  validation.log_density_per_experiment = logDensity(problem, fitted, asked, used, journal);
  if (asked == InitialState::automatic)
    validation.log_density_per_experiment =
        std::max(validation.log_density_per_experiment,
                 logDensity(problem, fitted, InitialState::zero, whole, journal));
  return validation;
}

}  // namespace uncertainty_identification
