#include "identification/short_gaps.h"

#include <cmath>

#include "data/bridged_output.h"
#include "estimation/simulation_fit.h"
#include "model/fixed_plant.h"

namespace uncertainty_identification {
namespace {

/// The samples of gaps that are short and lie between measured ones; none where many are missing.
std::vector<int> samplesOfShortGaps(const Experiment& experiment) {
  constexpr int kLongest = 3;
  constexpr double kMost = 0.05;  // of the samples
  std::vector<int> samples, gap;
  const int all = experiment.samples(), missing = all - experiment.validSamples();
  if (missing > kMost * all) return {};
  bool is_inside = false;
  for (int k = 0; k < all; ++k) {
    if (!experiment.isValid(k)) {
      gap.push_back(k);
      continue;
    }
    if (is_inside && gap.size() <= kLongest) samples.insert(samples.end(), gap.begin(), gap.end());
    gap.clear();
    is_inside = true;
  }
  return samples;
}

}  // namespace

std::vector<Experiment> withShortGapsFilled(std::vector<Experiment> experiments,
                                            const Polynomials& plant, double offset,
                                            const EstimationOptions& options) {
  const auto go = fixPlant(plant, 0, 0);
  for (Experiment& experiment : experiments) {
    const std::vector<int> samples = samplesOfShortGaps(experiment);
    if (samples.empty()) continue;
    Experiment whole = experiment;  // has an error at each sample
    whole.y = bridgedOutput(experiment);
    whole.valid.clear();
    Experiment error = experiment;
    error.y = simulationErrors(*go, Eigen::VectorXd(0), offset, options, {whole}).front();
    const Eigen::VectorXd simulated = whole.y - error.y, interpolated = bridgedOutput(error);
    if (!simulated.allFinite()) continue;
    for (const int k : samples) {
      experiment.y[k] = simulated[k] + interpolated[k];
      experiment.valid[static_cast<std::size_t>(k)] = 1;
    }
    if (experiment.validSamples() == experiment.samples()) experiment.valid.clear();
  }
  return experiments;
}

}  // namespace uncertainty_identification
