#include "uncertainty_identification/bounds/bounds.h"

#include <algorithm>
#include <chrono>

#include "uncertainty_identification/bounds/frequency_grid.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr int kRegions = 40;  // frequencies

/// Every so-manieth frequency.
Eigen::VectorXd someOf(const Eigen::VectorXd& omega) {
  const Eigen::Index count = std::min<Eigen::Index>(kRegions, omega.size());
  return Eigen::VectorXd::NullaryExpr(count, [&](Eigen::Index k) {
    return omega[count > 1 ? k * (omega.size() - 1) / (count - 1) : 0];
  });
}

}  // namespace

Bounds computeBounds(const Estimate& estimate) {
  const auto began = std::chrono::steady_clock::now();
  const BoundsOptions& options = estimate.configuration.bounds;
  const PlantDistribution plants(estimate);
  const Eigen::VectorXd omega =
      options.grid.size() > 0
          ? options.grid
          : frequencyGrid(estimate.nominal_model, std::max(options.frequencies, 10));
  Bounds bounds;
  bounds.levels = options.levels;
  bounds.samples = options.samples;
  bounds.seed = estimate.configuration.estimation.seed;
  if (!plants.hasEstimationErrors()) {
    bounds.warnings.push_back(
        "the errors of the estimate are not known: the bounds are those of the mixture alone, and "
        "too narrow");
  }
  bounds.frequency = frequencyBounds(plants, omega, options, bounds.seed);
  bounds.step = stepBounds(plants, options, bounds.seed);
  bounds.regions = complexRegions(plants, someOf(omega), options, bounds.seed);
  try {
    bounds.weight = uncertaintyWeight(plants, omega, options, bounds.seed);
  } catch (const DataError& error) {
    bounds.warnings.push_back(std::string("no robust-control weight: ") + error.what());
  }
  bounds.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return bounds;
}

}  // namespace uncertainty_identification
