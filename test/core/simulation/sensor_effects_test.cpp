#include "simulation/sensor_effects.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/hidden.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using test::expectNear;
using test::unitDelay;

/// y of experiment 1 of unitDelay(), with noise, and what `effects` make of it.
struct Pair {
  VectorXd plain, changed, x;
};

Pair pairOf(const SensorEffects& effects, int samples = 200) {
  Truth truth = unitDelay(samples);
  Pair pair;
  pair.x = simulateExperiment(truth, 4, 1).y;
  truth.noise.variance = 0.01;
  pair.plain = simulateExperiment(truth, 4, 1).y;
  truth.effects.sensor = effects;
  truth.validate();
  pair.changed = simulateExperiment(truth, 4, 1).y;
  return pair;
}

TEST(SensorEffects, WienerBendsTheOutputAndNotTheNoise) {
  SensorEffects effects;
  effects.wiener = {0.3, -0.1};
  const Pair pair = pairOf(effects);
  const auto x = pair.x.array();
  expectNear(pair.changed - pair.plain, (0.3 * x.square() - 0.1 * x.cube()).matrix());
}

TEST(SensorEffects, BiasAndDriftOfAllExperiments) {
  SensorEffects effects;
  effects.bias = {0.4, false, 9};
  effects.drift = {2, false, 9};
  const Pair pair = pairOf(effects);
  for (int t = 0; t < 200; ++t)
    EXPECT_NEAR(pair.changed(t) - pair.plain(t), 0.4 + 2 * t / 200.0, 1e-12);
}

TEST(SensorEffects, BiasAndDriftPerExperimentFollowTheirDeviation) {
  Truth truth = unitDelay();
  truth.effects.sensor.bias = {9, true, 0.4};
  truth.effects.sensor.drift = {9, true, 2};
  constexpr int kCount = 4000;
  Eigen::Array2d squares = Eigen::Array2d::Zero();
  for (int r = 0; r < kCount; ++r) {
    const EffectDraws draws = drawSystem(truth, 1, r).effects;
    squares += Eigen::Array2d(draws.bias, draws.drift).square() / kCount;
  }
  EXPECT_NEAR(squares(0), 0.16, 4 * 0.16 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(squares(1), 4, 4 * 4 * std::sqrt(2.0 / kCount));
  const EffectDraws draws = drawSystem(truth, 1, 1).effects;
  const VectorXd added =
      simulateExperiment(truth, 1, 1).y - simulateExperiment(unitDelay(), 1, 1).y;
  for (int t = 0; t < 200; ++t) EXPECT_NEAR(added(t), draws.bias + draws.drift * t / 200, 1e-12);
}

TEST(SensorEffects, HumKeepsOrDrawsItsPhase) {
  SensorEffects effects;
  effects.hum = {0.7, 0.5, 0.2, false};
  const Pair pair = pairOf(effects);
  for (int t = 0; t < 200; ++t)
    EXPECT_NEAR(pair.changed(t) - pair.plain(t), 0.7 * std::sin(0.5 * t + 0.2), 1e-12);
  Truth truth = unitDelay();
  truth.effects.sensor.hum = {0.7, 0.5, 0.2, true};
  const double phase = drawSystem(truth, 1, 0).effects.hum_phase;
  EXPECT_NE(phase, drawSystem(truth, 1, 1).effects.hum_phase);
  const VectorXd added =
      simulateExperiment(truth, 1, 0).y - simulateExperiment(unitDelay(), 1, 0).y;
  for (int t = 0; t < 200; ++t) EXPECT_NEAR(added(t), 0.7 * std::sin(0.5 * t + phase), 1e-12);
}

TEST(SensorEffects, LagFiltersTheNoiseToo) {
  SensorEffects effects;
  effects.lag = {0.7};
  const Pair pair = pairOf(effects);
  double lagged = 0;
  for (int t = 0; t < 200; ++t) {
    lagged = 0.7 * lagged + 0.3 * pair.plain(t);
    EXPECT_NEAR(pair.changed(t), lagged, 1e-12);
  }
}

TEST(SensorEffects, ClipBeforeOrBehindTheNoise) {
  SensorEffects effects;
  effects.clip = {0.8, false};
  const Pair behind = pairOf(effects);
  expectNear(behind.changed, behind.plain.cwiseMin(0.8).cwiseMax(-0.8));
  effects.clip->before_noise = true;
  const Pair before = pairOf(effects);
  expectNear(before.changed - before.plain, before.x.cwiseMin(0.8).cwiseMax(-0.8) - before.x);
}

TEST(SensorEffects, Quantisation) {
  SensorEffects effects;
  effects.quant = {0.25};
  const Pair pair = pairOf(effects);
  for (int t = 0; t < 200; ++t) {
    EXPECT_EQ(pair.changed(t), 0.25 * std::round(pair.changed(t) / 0.25));
    EXPECT_LE(std::abs(pair.changed(t) - pair.plain(t)), 0.125 + 1e-12);
  }
}

TEST(SensorEffects, OutliersAreRareAndOfTheirSize) {
  SensorEffects effects;
  effects.outliers = {0.05, 3};
  const Pair pair = pairOf(effects, 20000);
  const VectorXd added = pair.changed - pair.plain;
  const double count = (added.array() != 0).cast<double>().sum();
  EXPECT_NEAR(count, 1000, 4 * std::sqrt(950.0));
  EXPECT_NEAR(added.squaredNorm() / count, 9, 4 * 9 * std::sqrt(2.0 / 1000));
}

TEST(SensorEffects, DropoutRepeatsTheRecord) {
  SensorEffects effects;
  effects.dropout = {0.2};
  const Pair pair = pairOf(effects, 20000);
  int repeated = 0;
  for (int t = 1; t < 20000; ++t) {
    if (pair.changed(t) == pair.plain(t)) continue;
    EXPECT_EQ(pair.changed(t), pair.changed(t - 1));
    ++repeated;
  }
  EXPECT_NEAR(repeated, 4000, 4 * std::sqrt(3200.0));
}

TEST(SensorEffects, RectificationAndBurstsOfNoCatalogue) {
  Truth truth = unitDelay(5000);
  const VectorXd x = simulateExperiment(truth, 1, 0).y;
  truth.effects.unnamed.rectification = {0.25};
  expectNear(simulateExperiment(truth, 1, 0).y, 0.75 * x + 0.25 * x.cwiseAbs());
  truth.effects.unnamed.rectification.reset();
  truth.effects.unnamed.burst = {2, 0.02, 1, 0.8};
  const VectorXd added = simulateExperiment(truth, 1, 0).y - x;
  int begun = 0;
  for (int t = 2; t < 5000; ++t) {
    const double innovation =
        added(t) - 2 * 0.8 * std::cos(1.0) * added(t - 1) + 0.64 * added(t - 2);
    begun += std::abs(innovation) > 1e-9 ? 1 : 0;
  }
  EXPECT_NEAR(begun, 100, 4 * std::sqrt(98.0));
}

TEST(SensorEffects, TelegraphSwitchesTheGain) {
  Truth truth = unitDelay(20000);
  const VectorXd x = simulateExperiment(truth, 1, 0).y;
  truth.effects.unnamed.telegraph = {0.3, 0.05};
  const VectorXd y = simulateExperiment(truth, 1, 0).y;
  int switched = 0;
  for (int t = 1; t < 20000; ++t) {
    const double gain = y(t) / x(t);
    EXPECT_NEAR(std::abs(gain - 1), 0.3, 1e-9);
    if (t > 1) switched += std::abs(gain - y(t - 1) / x(t - 1)) > 0.1 ? 1 : 0;
  }
  EXPECT_NEAR(switched, 1000, 4 * std::sqrt(950.0));
}

}  // namespace
}  // namespace uncertainty_identification
