#include "uncertainty_identification/bounds/bounds.h"

#include <algorithm>
#include <chrono>

#include "bounds/frequency_grid.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr int kRegions = 40;  // largest number of frequencies with a complex region

/// An evenly spaced subset of the frequencies.
Eigen::VectorXd someOf(const Eigen::VectorXd& omega) {
  const Eigen::Index count = std::min<Eigen::Index>(kRegions, omega.size());
  return Eigen::VectorXd::NullaryExpr(count, [&](Eigen::Index k) {
    return omega[count > 1 ? k * (omega.size() - 1) / (count - 1) : 0];
  });
}

/// Whether the estimation errors are so large that linear propagation fails: responses depend
/// nonlinearly on the parameters, so the median of plants drawn with these errors then differs from
/// that of plants drawn without.
bool errorsAreNonlinear(const FrequencyBounds& bounds) {
  constexpr double kShare = 0.1;  // share of frequencies at which it must be so
  const UncertaintyBands& bands = bounds.magnitude_bands;
  if (bands.total.empty()) return false;
  const Band &mixture = bands.mixture.pointwise.front(), &total = bands.total.pointwise.front();
  const Eigen::ArrayXd center = (mixture.lower + mixture.upper) / 2;
  const auto outside = center < total.lower.array() || center > total.upper.array();
  return static_cast<double>(outside.count()) > kShare * static_cast<double>(center.size());
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
  bounds.trust = estimate.trust;
  bounds.seed = estimate.configuration.estimation.seed;
  if (!plants.hasEstimationErrors()) {
    bounds.warnings.push_back(
        "the estimation errors are not known: the bounds contain only the spread of the mixture "
        "and are too narrow");
  }
  bounds.frequency = frequencyBounds(plants, omega, options, bounds.seed);
  if (errorsAreNonlinear(bounds.frequency)) {
    bounds.warnings.push_back(
        "the estimation errors are so large that their linear propagation to the bounds is "
        "inaccurate: lower the orders, or record more or longer experiments");
  }
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
