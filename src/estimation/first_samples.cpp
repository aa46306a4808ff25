#include "estimation/first_samples.h"

#include <algorithm>

#include "data/unmeasured_start.h"
#include "estimation/excerpt.h"
#include "estimation/likelihood.h"
#include "model/evaluation.h"

namespace uncertainty_identification {

double firstSamplesDensity(const LinearModel& model, const ModelParameters& point,
                           const std::vector<Experiment>& experiments, int threads, int* passes) {
  constexpr int kEnough = 30;       // samples, for a few initial values amid noise
  constexpr int kSmallestPart = 5;  // of the shortest experiment
  int first = kEnough;
  for (const Experiment& experiment : experiments)
    first = std::min(first, experiment.samples() / kSmallestPart);
  if (first == 0) return 0;
  std::vector<Experiment> beginnings;
  beginnings.reserve(experiments.size());
  for (const Experiment& experiment : experiments)
    beginnings.push_back(
        excerpt(experiment, 0,
                std::min(samplesBeforeFirstMeasured(experiment) + first, experiment.samples())));
  const std::vector<Block> blocks = makeBlocks(beginnings);
  const Likelihood likelihood(model, blocks, static_cast<int>(beginnings.size()), threads);
  const Statistics statistics = likelihood.statistics(point.parameters, false);
  *passes += likelihood.passes();
  return likelihood.expect(statistics, point).total();
}

bool hasUnknownsOfExperiments(const EstimationOptions& options) {
  return estimatesInitialState(options) || options.offsets == Offsets::per_experiment;
}

}  // namespace uncertainty_identification
