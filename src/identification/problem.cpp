#include "identification/problem.h"

#include <algorithm>

#include "configuration/thread_count.h"
#include "effects/extended_model.h"
#include "model/fixed_plant.h"
#include "model/sensitivity_model.h"

namespace uncertainty_identification {

long CheckedData::validSamples() const {
  long samples = 0;
  for (const Experiment& experiment : experiments) samples += experiment.validSamples();
  return samples;
}

int CheckedData::movedInputs() const {
  return static_cast<int>(
      std::count_if(experiments.begin(), experiments.end(), [](const Experiment& experiment) {
        return (experiment.u.array() != experiment.u[0]).any();
      }));
}

OptimisationOptions optimisationOptions(const Configuration& configuration, Phase phase,
                                        ProgressPhases* progress) {
  OptimisationOptions options;
  options.constraint = configuration.error_model.constraint;
  options.max_iterations = configuration.estimation.max_iterations;
  options.tolerance = configuration.estimation.tolerance;
  options.on_iterate = [phase, progress](const TracePoint& done) {
    const double share =
        1 - 1 / (1 + 0.1 * done.iteration);  // the number of iterations is not known in advance
    return progress->report(phase, share, done.log_likelihood);
  };
  return options;
}

std::shared_ptr<const NominalModel> nominalModelOf(const Problem& problem) {
  const double sample_time = problem.data.sampleTime();
  return problem.nominal_model ? problem.nominal_model(sample_time)
                               : makeNominalModel(problem.configuration.nominal_model, sample_time);
}

std::shared_ptr<const NominalModel> remainingNominalModel(const Problem& problem) {
  if (!problem.plant) return nominalModelOf(problem);
  const NominalModelOptions& options = problem.configuration.nominal_model;
  const bool white = options.structure == Structure::output_error;
  return fixPlant(problem.plant->polynomials, white ? 0 : options.nc, white ? 0 : options.nd);
}

std::unique_ptr<LinearModel> buildModel(const Problem& problem) {
  const Configuration& configuration = problem.configuration;
  const auto nominal = remainingNominalModel(problem);
  if (configuration.effects.empty())
    return makeLinearModel(nominal, configuration.error_model, configuration.estimation);
  return makeExtendedModel(nominal, configuration, problem.data.experiments);
}

std::unique_ptr<Likelihood> likelihoodOf(const Problem& problem, const LinearModel& model) {
  return std::make_unique<Likelihood>(model, problem.data.blocks, problem.data.count(),
                                      threadCount(problem.configuration.estimation.threads));
}

}  // namespace uncertainty_identification
