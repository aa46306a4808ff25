#include <algorithm>
#include <cmath>

#include "estimation/least_squares_start.h"
#include "identification/steps.h"

/// The prior of the experiments' unknown initial values.
namespace uncertainty_identification {
namespace {

/// Number, sum and sum of squares of measured outputs.
struct Moments {
  double count = 0, sum = 0, squares = 0;

  void add(const Experiment& experiment) {
    for (int k = 0; k < experiment.samples(); ++k) {
      if (!experiment.isValid(k)) continue;
      ++count;
      sum += experiment.y[k];
      squares += experiment.y[k] * experiment.y[k];
    }
  }
  double variance() const { return std::max((squares - sum * sum / count) / count, 1e-300); }
};

/// Variance of the noise relative to that of the output: the median over some experiments of the
/// errors that an ARX model of each predicts one step ahead with. One model of all would count the
/// differences between the experiments as noise.
double noiseShare(const std::vector<Experiment>& experiments) {
  constexpr int kOrder = 4, kMostSamples = 5000;
  constexpr std::size_t kMostExperiments = 15;
  std::vector<double> shares;
  const std::size_t stride = 1 + (experiments.size() - 1) / kMostExperiments;
  for (std::size_t r = 0; r < experiments.size(); r += stride) {
    const LeastSquaresStart one({&experiments[r]}, Constant::common, kMostSamples);
    Moments of_output;
    of_output.add(experiments[r]);
    const double freedom = std::min<double>(of_output.count, kMostSamples) - 3 * kOrder - 1;
    const double share =
        one.arx(kOrder, kOrder, 0).residual_squares / freedom / of_output.variance();
    if (freedom > 0 && std::isfinite(share)) shares.push_back(share);
  }
  if (shares.empty()) return 1;
  std::nth_element(shares.begin(), shares.begin() + static_cast<long>(shares.size() / 2),
                   shares.end());
  return shares[shares.size() / 2];
}

}  // namespace

double outputVariance(const std::vector<Experiment>& experiments) {
  Moments moments;
  for (const Experiment& experiment : experiments) moments.add(experiment);
  return moments.variance();
}

Configuration chooseInitialState(Configuration configuration, const CheckedData& data,
                                 Journal* journal) {
  constexpr double kDeviations = 10;  // of the outputs: wide, but proper
  constexpr double kMargin = 10;      // the noise may be smaller than what an ARX model leaves
  constexpr double kLeast = 1e-12, kMost = 1e-4;
  EstimationOptions& options = configuration.estimation;
  if (options.initial_state == InitialState::automatic) {
    const bool at_rest = !data.are_cut && startAtRest(data.experiments, options);
    options.initial_state = at_rest ? InitialState::zero : InitialState::estimate;
    journal->candidates.push_back(
        {"initial state", at_rest ? "at rest" : "unknown", 0, {}, {}, {}, true, {}});
  }
  if (options.initial_variance == kAutomatic)
    options.initial_variance = kDeviations * kDeviations * outputVariance(data.experiments);
  if (options.initial_precision == kAutomatic)
    options.initial_precision = std::clamp(
        noiseShare(data.experiments) / (kMargin * kDeviations * kDeviations), kLeast, kMost);
  return configuration;
}

}  // namespace uncertainty_identification
