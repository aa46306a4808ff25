#include "simulation/noise_effects.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/hidden.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using test::expectNear;
using test::vectorOf;

/// v alone: a plant without gain, and unit variance of w.
Truth noiseAlone(int samples) {
  Truth truth = test::unitDelay(samples);
  truth.plant.b = VectorXd::Zero(1);
  truth.noise.variance = 1;
  return truth;
}

TEST(NoiseEffects, ColourMultipliesTheDenominator) {
  for (const NoiseStart start : {NoiseStart::zero, NoiseStart::stationary}) {
    Truth coloured = noiseAlone(300), plain = noiseAlone(300);
    coloured.noise.start = plain.noise.start = start;
    coloured.noise.c = plain.noise.c = vectorOf({0.3});
    coloured.noise.d = vectorOf({-0.5});
    coloured.effects.noise.colour = {-0.9, 0.4};
    plain.noise.d = vectorOf({-1.4, 0.85, -0.2});  // (1 - 0.5 q^-1)(1 - 0.9 q^-1 + 0.4 q^-2)
    expectNear(simulateExperiment(coloured, 1, 0).y, simulateExperiment(plain, 1, 0).y, 1e-9);
  }
}

TEST(NoiseEffects, TailsAreHeavyAtTheSameVariance) {
  Truth truth = noiseAlone(200000);
  truth.effects.noise.tails = {10};
  const auto w = simulateExperiment(truth, 1, 0).y.array();
  // Kurtosis of t_10 is 3 + 6/(10 - 4) = 4; its standard error, from the eighth moment, about 0.03.
  EXPECT_NEAR(w.square().mean(), 1, 4 * std::sqrt(3.0 / 200000));
  EXPECT_NEAR(w.square().square().mean(), 4, 0.15);
}

TEST(NoiseEffects, VarianceFollowsItsDriver) {
  Truth truth = noiseAlone(300);
  const VectorXd w = simulateExperiment(truth, 1, 0).y;
  truth.effects.noise.hetero = {0.6, HeteroDriver::input, 2};
  const Experiment of_input = simulateExperiment(truth, 1, 0);
  for (int t = 0; t < 300; ++t) {
    const double variance = 0.4 + 0.6 * std::pow(of_input.u(t) / 2, 2);
    EXPECT_NEAR(of_input.y(t), w(t) * std::sqrt(variance), 1e-12);
  }
  truth.plant.b = VectorXd::Ones(1);
  truth.effects.noise.hetero->driver = HeteroDriver::output;
  const Experiment of_output = simulateExperiment(truth, 1, 0);
  for (int t = 1; t < 300; ++t) {
    const double x = of_output.u(t - 1);
    EXPECT_NEAR(of_output.y(t) - x, w(t) * std::sqrt(0.4 + 0.6 * x * x / 4), 1e-12);
  }
}

TEST(NoiseEffects, StepOfTheDeviation) {
  Truth truth = noiseAlone(300);
  const VectorXd w = simulateExperiment(truth, 1, 0).y;
  truth.effects.noise.step = {3, 100};
  const VectorXd y = simulateExperiment(truth, 1, 0).y;
  expectNear(y.head(100), w.head(100));
  expectNear(y.tail(200), 3 * w.tail(200));
}

}  // namespace
}  // namespace uncertainty_identification
