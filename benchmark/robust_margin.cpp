#include "uncertainty_identification/control/robust_margin.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "bounds/frequency_grid.h"
#include "math/polynomial.h"
#include "simulation/simulate.h"
#include "support/monte_carlo.h"
#include "uncertainty_identification/bounds/uncertainty_weight.h"
#include "uncertainty_identification/identifier.h"

/// Integral controllers with increasing gain on Example 1: the margin and the probability of
/// instability computed from identified models, compared with the share of true systems for which
/// the loop is unstable. Exits with 1 if a loop with margin above 1 is unstable with more plants
/// than W leaves out, or if a mean probability is off by more than 2 percentage points (its
/// standard error is about 1).
namespace uncertainty_identification::test {
namespace {

constexpr int kSystems = 20000;
constexpr int kIdentifications = 25;

/// The true systems as plants, drawn one by one.
PlantSamples trueSystems(const Truth& truth) {
  const ErrorBasis basis(truth.error_model.basis);
  PlantSamples plants;
  plants.sample_time = truth.sample_time;
  plants.delay = truth.plant.delay;
  plants.basis = truth.error_model.basis;
  plants.b = truth.plant.b.transpose().replicate(kSystems, 1);
  plants.a = truth.plant.a.transpose().replicate(kSystems, 1);
  plants.eta = Eigen::MatrixXd(kSystems, basis.taps());
  for (int r = 0; r < kSystems; ++r)
    plants.eta.row(r) = (basis.T() * drawSystem(truth, 77, r).xi).transpose();
  return plants;
}

double unstableShare(const PlantSamples& plants, const RationalFunction& controller) {
  const Eigen::MatrixXd all = characteristicPolynomials(plants, controller);
  int unstable = 0;
  for (Eigen::Index i = 0; i < all.rows(); ++i)
    unstable += isStable(all.row(i).transpose()) ? 0 : 1;
  return static_cast<double>(unstable) / static_cast<double>(all.rows());
}

/// What the models say of one controller, over the identifications.
struct Record {
  double gain;
  double margin = 0, frequency = 0, unstable = 0, unstable_square = 0;  ///< sums
};

RobustMarginOptions controllerOf(double gain) {
  RobustMarginOptions options;
  options.controller = {Eigen::VectorXd::Constant(1, gain), Eigen::Vector2d(1, -1)};
  return options;
}

/// False where a loop with margin is unstable with more plants than W leaves out.
bool judge(std::uint64_t seed, std::vector<Record>* records) {
  const Estimate estimate = Identifier(example1AtRest()).identify(simulate(example1Truth(), seed));
  const PlantDistribution plants(estimate);
  const BoundsOptions bounds;
  const UncertaintyWeight weight = uncertaintyWeight(
      plants, frequencyGrid(estimate.nominal_model, bounds.frequencies), bounds, 1);
  bool good = true;
  for (Record& record : *records) {
    const RobustMargin found =
        robustMargin(plants, {weight.num, weight.den}, controllerOf(record.gain));
    record.margin += found.margin / kIdentifications;
    record.frequency += found.peak_omega / kIdentifications;
    record.unstable += found.unstable_probability / kIdentifications;
    record.unstable_square += std::pow(found.unstable_probability, 2) / kIdentifications;
    good = good && (!found.robust() || found.unstable_probability <= 1 - weight.level);
  }
  return good;
}

int study() {
  const PlantSamples systems = trueSystems(example1Truth());
  std::vector<Record> records;
  for (const double gain : {0.05, 0.1, 0.2, 0.3, 0.5, 0.8, 1.2, 2.0}) records.push_back({gain});
  bool good = true;
  for (int k = 1; k <= kIdentifications; ++k)
    good = judge(static_cast<std::uint64_t>(k), &records) && good;
  std::printf(
      "Example 1, %d identifications from 100 experiments each; W at level 0.95;\n"
      "K = gain/(1 - q^-1); +-: standard deviation between identifications\n\n"
      "%6s %8s %12s %26s %24s\n",
      kIdentifications, "gain", "margin", "at [rad/s]", "unstable [%] by the model",
      "of 20,000 true systems");
  for (const Record& record : records) {
    const double truly = unstableShare(systems, controllerOf(record.gain).controller);
    const double deviation =
        std::sqrt(std::max(record.unstable_square - record.unstable * record.unstable, 0.0));
    std::printf("%6.2f %8.3f %12.1f %17.2f +- %5.2f %24.2f\n", record.gain, record.margin,
                record.frequency, 100 * record.unstable, 100 * deviation, 100 * truly);
    good = good && std::abs(record.unstable - truly) < 0.02;
  }
  std::printf("\n%s\n", good ? "passed" : "FAILED");
  return good ? 0 : 1;
}

}  // namespace
}  // namespace uncertainty_identification::test

int main() { return uncertainty_identification::test::study(); }
