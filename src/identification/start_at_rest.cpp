#include <algorithm>
#include <cmath>
#include <limits>

#include "estimation/least_squares_start.h"
#include "estimation/simulation_fit.h"
#include "identification/steps.h"
#include "model/fixed_plant.h"

/// Whether initial states must be estimated. Where experiments start at rest, unknown initial
/// values with a wide prior would cost likelihood with each further state of the model, and the
/// smaller of two structures would be chosen for that alone.
namespace uncertainty_identification {
namespace {

/// The pooled second-order model whose simulation the first samples are compared with.
LeastSquaresModel simpleModel(const std::vector<Experiment>& experiments,
                              const EstimationOptions& options) {
  constexpr int kOrder = 2, kMostSamples = 20000, kLongestDelay = 20;
  std::vector<const Experiment*> all;
  int shortest = experiments.front().samples();
  for (const Experiment& experiment : experiments) {
    all.push_back(&experiment);
    shortest = std::min(shortest, experiment.samples());
  }
  const LeastSquaresStart start(all, options.offsets != Offsets::none, kMostSamples);
  return start.steiglitzMcBride(kOrder, kOrder, 0, std::min(kLongestDelay, shortest / 4));
}

/// Mean square of the errors at measured samples: of the first ones of each experiment, or of all.
/// Larger squares count as `most`.
double meanSquare(const std::vector<Eigen::VectorXd>& errors,
                  const std::vector<Experiment>& experiments, int first, double most) {
  double squares = 0, count = 0;
  for (std::size_t r = 0; r < errors.size(); ++r) {
    for (int k = 0, measured = 0; k < errors[r].size() && measured < first; ++k) {
      if (!experiments[r].isValid(k)) continue;
      ++measured;
      ++count;
      squares += std::min(errors[r][k] * errors[r][k], most);
    }
  }
  return squares / std::max(count, 1.0);
}

}  // namespace

bool startAtRest(const std::vector<Experiment>& experiments, const EstimationOptions& options) {
  constexpr std::size_t kFewest = 3;
  constexpr int kFirst = 4, kAll = std::numeric_limits<int>::max();
  constexpr double kMostUnexplained = 0.25;  // of the variance of the outputs
  constexpr double kLargest = 9;  // squares relative to the mean; noise may have heavy tails
  constexpr double kSlack = 0.25, kDeviations = 1.5;  // of a mean of one square per experiment
  if (experiments.size() < kFewest) return false;
  const LeastSquaresModel simple = simpleModel(experiments, options);
  const auto nominal = fixPlant(simple.polynomials, 0, 0);
  const auto errorsFrom = [&](InitialState state) {
    EstimationOptions from = options;
    from.initial_state = state;
    return simulationErrors(*nominal, Eigen::VectorXd(0), simple.offset, from, experiments);
  };
  const double usual = meanSquare(errorsFrom(InitialState::estimate), experiments, kAll,
                                  std::numeric_limits<double>::infinity());
  // Errors as large as the outputs, as where plants differ much, show nothing of the start.
  if (!(usual < kMostUnexplained * outputVariance(experiments))) return false;
  const double at_rest =
      meanSquare(errorsFrom(InitialState::zero), experiments, kFirst, kLargest * usual);
  const double margin = kSlack + kDeviations / std::sqrt(static_cast<double>(experiments.size()));
  return at_rest < (1 + margin) * usual;
}

}  // namespace uncertainty_identification
