// How far the data leave the plant open. The plants are simulated here, exactly.
#include "identification/structure_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <random>

#include "math/constants.h"
#include "uncertainty_identification/bounds/uncertainty_bounds.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

constexpr int kReadings = 400;
constexpr double kHeld = 10;  // [s]

/// Three lags in a row, as of an oven with its wall and its sensor; the sensor's lag is hidden by
/// noise.
struct Oven {
  double gain, wall, air, sensor;  // [K/W], [s], [s], [s]

  double magnitude(double omega) const {
    double squared = gain * gain;
    for (const double lag :
         {wall, air, sensor}) {  // held input: exact in discrete time for each lag
      const double pole = std::exp(-kHeld / lag);
      squared *= std::norm((1 - pole) / (1.0 - pole * std::polar(1.0, -omega * kHeld)));
    }
    return std::sqrt(squared);
  }

  Experiment measured(int seed, double noise) const {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    std::normal_distribution<double> normal;
    Experiment experiment{"run_" + std::to_string(seed),
                          kHeld,
                          0,
                          VectorXd(kReadings),
                          VectorXd(kReadings),
                          {},
                          {},
                          {},
                          {},
                          {}};
    double x[3] = {0, 0, 0}, level = 0;
    const double lags[3] = {wall, air, sensor};
    for (int k = 0; k < kReadings; ++k) {
      if (k % 60 == 5) level = 50 + 30 * normal(random);
      experiment.u[k] = level;
      experiment.y[k] = x[2] + noise * normal(random);
      double input = gain * level;
      for (int i = 0; i < 3; ++i) {
        const double pole = std::exp(-kHeld / lags[i]);
        x[i] = pole * x[i] + (1 - pole) * input;
        input = x[i];
      }
    }
    return experiment;
  }
};

std::vector<Experiment> ovens(int count, double noise) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<Experiment> all;
  for (int seed = 1; seed <= count; ++seed)
    all.push_back(Oven{2 * (1 + 0.05 * normal(random)), 600, 60, 20}.measured(seed, noise));
  return all;
}

Configuration automatic() {
  Configuration configuration;
  configuration.nominal_model.orders_auto = true;
  return configuration;
}

// White input of variance 1: the sum of |U|^2 over the octave's w N/(2 sqrt(2) 2 pi/2) frequencies.
TEST(StructureErrorTest, IsTheErrorOfAResponseInOneOctave) {
  constexpr int kCount = 40;
  Estimate estimate;
  estimate.nominal_model.sample_time = 0.5;
  estimate.nominal_model.b = VectorXd::Constant(1, 2);
  estimate.noise_variance.value = 0.09;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<Experiment> experiments(kCount);
  for (Experiment& experiment : experiments) {
    experiment.sample_time = 0.5;
    experiment.u = VectorXd::NullaryExpr(kReadings, [&] { return normal(random); });
    experiment.y = VectorXd::Zero(kReadings);
  }
  const StructureError error = structureErrorOf(experiments, estimate);
  EXPECT_NEAR(error.omega[error.omega.size() - 1], kPi / 0.5, 1e-12);
  for (const Eigen::Index before : {12, 20, 28, 36}) {
    const Eigen::Index k = error.omega.size() - 1 - before;
    const double bins =
        (std::sqrt(2.0) - std::sqrt(0.5)) * error.omega[k] * 0.5 * kReadings / (2 * kPi);
    const double expected = std::sqrt(0.09 / (4 * kCount * bins));
    EXPECT_NEAR(error.relative[k] / expected, 1, 0.1) << "at " << error.omega[k] << " rad/s";
  }
}

// A gain of one and noise of 1 %.
StructureError errorWith(const std::function<double(int)>& input, int readings = kReadings) {
  Estimate estimate;
  estimate.nominal_model.sample_time = 1;
  estimate.nominal_model.b = VectorXd::Ones(1);
  estimate.noise_variance.value = 1e-4;
  Experiment experiment;
  experiment.sample_time = 1;
  experiment.u =
      VectorXd::NullaryExpr(readings, [&](Eigen::Index k) { return input(static_cast<int>(k)); });
  experiment.y = VectorXd::Zero(readings);
  return structureErrorOf({experiment}, estimate);
}

// The sine begins and ends in mid-swing. Beyond an octave and a half its power is none.
TEST(StructureErrorTest, ASmoothInputThatIsCutOffTellsNothingOfHighFrequencies) {
  const StructureError error =
      errorWith([](int k) { return std::sin(0.3 * k + 2e-4 * k * k / 2); });
  for (Eigen::Index k = 0; k < error.omega.size(); ++k) {
    if (error.omega[k] > 0.25 && error.omega[k] < 0.35) {
      EXPECT_LT(error.relative[k], 0.01);
    }
    if (error.omega[k] > 1) {
      EXPECT_GT(error.relative[k], 1) << "at " << error.omega[k] << " rad/s";
    }
  }
}

// |U| of a step of height 1, differenced, is 1 at all frequencies.
TEST(StructureErrorTest, AStepTellsWhereverItIs) {
  for (const int at : {1, 3, 200, 397, 399}) {
    const StructureError error = errorWith([&](int k) { return k < at ? 0 : 1; });
    const Eigen::Index last = error.omega.size() - 5;  // in the middle of a whole octave
    const double frequencies =
        (std::sqrt(2.0) - std::sqrt(0.5)) * error.omega[last] * kReadings / (2 * kPi);
    const double expected = std::sqrt(1e-4 * std::norm(1.0 - std::polar(1.0, error.omega[last])) *
                                      kReadings / frequencies);
    EXPECT_NEAR(error.relative[last] / expected, 1, 0.05) << "at " << at;
  }
}

TEST(StructureErrorTest, InputsThatRestAtTheirEndsTellTheSameWhereverTheyMove) {
  constexpr int kFew = 20;
  const auto step = [](int k) { return k < 0 ? 0.0 : 1.0; };
  const auto burst = [](int k) { return k < 0 || k > 40 ? 0.0 : k * std::sin(0.4 * k); };
  const auto same = [](const StructureError& one, const StructureError& other) {
    EXPECT_TRUE(one.relative.isApprox(other.relative, 1e-9));
  };
  for (const int at : {1, 2, kFew - 1})
    same(errorWith([&](int k) { return step(k - at); }, kFew),
         errorWith([&](int k) { return step(k - kFew / 2); }, kFew));
  for (const int at : {3, kReadings - 50})
    same(errorWith([&](int k) { return burst(k - at); }),
         errorWith([&](int k) { return burst(k - kReadings / 2); }));
}

TEST(StructureErrorTest, OutputsThatAreMissingTellNothing) {
  std::vector<Experiment> experiments = ovens(1, 0.3);
  Estimate estimate;
  estimate.nominal_model.sample_time = kHeld;
  estimate.nominal_model.b = VectorXd::Ones(1);
  estimate.noise_variance.value = 1;
  const double all = structureErrorOf(experiments, estimate).relative[10];
  experiments[0].valid.assign(kReadings, 1);
  std::fill_n(experiments[0].valid.begin(), kReadings * 3 / 4, 0);
  EXPECT_NEAR(structureErrorOf(experiments, estimate).relative[10], 2 * all, 1e-9 * all);
}

// Noise hides the sensor's lag; the chosen model has none, and falls less steeply.
TEST(StructureErrorTest, BandsHoldThePlantWhereNoiseHidesIt) {
  const Estimate estimate = Identifier(automatic()).identify(ovens(8, 1));
  ASSERT_TRUE(estimate.usable()) << estimate.message;
  const VectorXd omega = VectorXd::LinSpaced(40, std::log(0.02), std::log(0.3)).array().exp();
  const auto held = [&](const Estimate& of) {
    const FrequencyBounds bounds = frequencyBounds(PlantDistribution(of), omega, {}, 1);
    const Band& band = bounds.magnitude_bands.total.pointwise[2];
    int inside = 0;
    for (Eigen::Index k = 0; k < omega.size(); ++k) {
      const double truth = Oven{2, 600, 60, 20}.magnitude(omega[k]);
      inside += band.lower[k] <= truth && truth <= band.upper[k] ? 1 : 0;
    }
    return inside;
  };
  EXPECT_EQ(held(estimate), omega.size());
  Estimate without = estimate;
  without.structure_error = {};
  EXPECT_LT(held(without), omega.size() / 2) << "the plant is simple enough to be identified";
}

TEST(StructureErrorTest, IsLeftOutWhereTheOrdersAreStated) {
  Configuration stated = automatic();
  stated.nominal_model.orders_auto = false;
  stated.nominal_model.nb = stated.nominal_model.na = 1;
  stated.error_model.taps = 0;
  const std::vector<Experiment> data = ovens(2, 0.3);
  EXPECT_EQ(Identifier(stated).identify(data).structure_error.omega.size(), 0);
  const Identifier choosing(automatic());
  const Estimate chosen = choosing.identify(data);
  ASSERT_GT(chosen.structure_error.omega.size(), 0);
  EXPECT_GT(choosing.reidentify(chosen, data).structure_error.omega.size(), 0)
      << "orders that are kept were chosen all the same";
}

}  // namespace
}  // namespace uncertainty_identification
