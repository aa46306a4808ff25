#include "identification/own_levels.h"

#include <algorithm>
#include <cmath>

#include "estimation/least_squares_start.h"
#include "math/distributions.h"

namespace uncertainty_identification {
namespace {

constexpr int kOrder = 6, kDelay = 0;
constexpr int kMostSamples = 5000;  // of each experiment

LeastSquaresModel fitted(const Experiment& experiment, bool with_constant) {
  return LeastSquaresStart({&experiment}, with_constant ? Constant::common : Constant::none,
                           kMostSamples)
      .arx(kOrder + 1, kOrder, kDelay);
}

}  // namespace

bool levelsDiffer(const std::vector<Experiment>& experiments) {
  constexpr double kImprobable = 1e-3;
  std::vector<LeastSquaresModel> own;
  std::vector<double> levels;
  for (const Experiment& experiment : experiments) {
    own.push_back(fitted(experiment, true));
    levels.push_back(own.back().offset);
  }
  const auto middle = levels.begin() + static_cast<long>(levels.size() / 2);
  std::nth_element(levels.begin(), middle, levels.end());
  double statistic = 0;
  for (std::size_t r = 0; r < experiments.size(); ++r) {
    Experiment moved = experiments[r];
    moved.y.array() -= *middle;
    const double samples = std::min(moved.validSamples(), kMostSamples) - 3 * kOrder - 2;
    const double ratio = fitted(moved, false).residual_squares / own[r].residual_squares;
    if (samples > 0 && std::isfinite(ratio)) statistic += samples * std::log(std::max(ratio, 1.0));
  }
  return chiSquaredTail(statistic, static_cast<double>(experiments.size())) < kImprobable;
}

}  // namespace uncertainty_identification
