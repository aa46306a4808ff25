// Bias, gain and delay that are known, because the measured output is made of them: y(t) = bias +
// gain s(t - delay) + e(t), with s a sum of sines that is evaluated at any time, and autoregressive
// noise e.

#include "own_simulation/simulation_errors.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "own_simulation/describe_errors.h"

namespace uncertainty_identification {
namespace {

constexpr double kStep = 0.02;  // [s]
constexpr double kBias = 0.4, kGain = 1.1, kDelay = 0.03;

double simulatedAt(double t) {
  return 1 + std::sin(2.1 * t) + 0.6 * std::sin(5.3 * t + 1) + 0.3 * std::sin(11.9 * t + 2);
}

Eigen::VectorXd sampled(int samples, double delay) {
  Eigen::VectorXd signal(samples);
  for (int k = 0; k < samples; ++k) signal[k] = simulatedAt(k * kStep - delay);
  return signal;
}

/// e(k) = pole e(k - 1) + w(k), stationary, with standard deviation `deviation`.
Eigen::VectorXd autoregressive(int samples, double pole, double deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, deviation);
  Eigen::VectorXd noise(samples);
  double before = normal(random);
  for (int k = 0; k < samples; ++k) {
    noise[k] = before;
    before = pole * before + std::sqrt(1 - pole * pole) * normal(random);
  }
  return noise;
}

SimulationErrors errorsOf(const Eigen::VectorXd& y, const Eigen::VectorXd& y_sim) {
  return simulationErrors(y, Eigen::ArrayXd::Ones(y.size()), y_sim, kStep);
}

Eigen::VectorXd measured(int samples, double delay) {
  return kBias + kGain * sampled(samples, delay).array();
}

TEST(SimulationErrors, AreExactWithoutNoise) {
  for (const double delay : {-0.013, 0.0, kDelay, 0.4}) {
    const SimulationErrors errors = errorsOf(measured(800, delay), sampled(800, 0));
    EXPECT_NEAR(errors.bias.value, kBias, 1e-4);
    EXPECT_NEAR(errors.gain.value, kGain, 1e-4);
    EXPECT_NEAR(errors.delay.value, delay, 1e-5);
    EXPECT_TRUE(errors.untold.empty());
  }
}

// Where no delay is the truth, steps lead to both sides of it, on which other samples overlap.
TEST(SimulationErrors, NoDelayIsFoundWithNoise) {
  for (unsigned seed = 1; seed <= 400; ++seed) {
    const SimulationErrors errors =
        errorsOf(measured(100, 0) + autoregressive(100, 0.5, 0.3, seed), sampled(100, 0));
    EXPECT_NEAR(errors.delay.value, 0, 0.1) << seed;
  }
}

// From no delay, Gauss and Newton's method would end at a wrong period of the fastest sine.
TEST(SimulationErrors, ADelayOfSeveralPeriodsIsFound) {
  const SimulationErrors errors = errorsOf(measured(2000, 2.507), sampled(2000, 0));
  EXPECT_NEAR(errors.delay.value, 2.507, 1e-5);
  EXPECT_NEAR(errors.gain.value, kGain, 1e-4);
}

TEST(SimulationErrors, TheFitIsThatOfItsDefinition) {
  const Eigen::VectorXd y = measured(300, kDelay), y_sim = sampled(300, 0);
  const double deviation = (y.array() - y.mean()).matrix().norm();
  EXPECT_NEAR(errorsOf(y, y_sim).fit.value, 100 * (1 - (y - y_sim).norm() / deviation), 1e-9);
  EXPECT_EQ(errorsOf(y, y).fit.value, 100);
}

// The standard errors follow from the regression with the derivatives in closed form, whose
// residuals are white here.
TEST(SimulationErrors, StandardErrorsOfWhiteNoiseAreThoseOfLeastSquares) {
  constexpr int kSamples = 4000;
  constexpr double kDeviation = 0.2;
  Eigen::MatrixXd columns(kSamples, 3);
  for (int k = 0; k < kSamples; ++k) {
    const double t = k * kStep - kDelay;
    columns.row(k) << 1, simulatedAt(t),
        -kGain * (simulatedAt(t + 1e-4) - simulatedAt(t - 1e-4)) / 2e-4;
  }
  const Eigen::Vector3d expected =
      kDeviation * (columns.transpose() * columns).inverse().diagonal().cwiseSqrt();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  constexpr unsigned kSeeds = 40;  // each estimate has 32 degrees of freedom
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const SimulationErrors errors =
        errorsOf(measured(kSamples, kDelay) + autoregressive(kSamples, 0, kDeviation, seed),
                 sampled(kSamples, 0));
    squares += Eigen::Vector3d(errors.bias.standard_error, errors.gain.standard_error,
                               errors.delay.standard_error)
                   .cwiseAbs2();
  }
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(std::sqrt(squares[i] / kSeeds) / expected[i], 1, 0.1) << i;
}

bool holds(const ErrorNumber& number, double truth) {
  return number.lower <= truth && truth <= number.upper;
}

struct Correlation {
  int samples;
  double pole;
};

// 95 % intervals of 400 data sets miss 20 times, with a binomial standard deviation of 4.4. Noise
// with a time constant of ten samples makes the classical intervals four times too narrow; the
// slowest sine takes 150 samples for a period, so that 300 samples hold two.
TEST(SimulationErrors, IntervalsHoldTheTruthAsOftenAsTheySayWithCorrelatedNoise) {
  constexpr unsigned kSeeds = 400;
  constexpr int kFewest = 362, kMost = 396;  // 95 % - 4 and + 3.7 standard deviations
  for (const auto& [samples, pole] : {Correlation{1000, 0}, {1000, 0.9}, {300, 0.8}}) {
    int bias = 0, gain = 0, delay = 0;
    for (unsigned seed = 1; seed <= kSeeds; ++seed) {
      const SimulationErrors errors =
          errorsOf(measured(samples, kDelay) + autoregressive(samples, pole, 0.3, seed),
                   sampled(samples, 0));
      bias += holds(errors.bias, kBias);
      gain += holds(errors.gain, kGain);
      delay += holds(errors.delay, kDelay);
    }
    for (const int count : {bias, gain, delay}) {
      EXPECT_GE(count, kFewest) << samples << " samples, pole " << pole;
      EXPECT_LE(count, kMost) << samples << " samples, pole " << pole;
    }
  }
}

// Two seconds are shorter than the period of the slowest sine. The regression takes so much out of
// the residuals that without making up for it a fifth of the intervals would miss.
TEST(SimulationErrors, IntervalsFromFewSamplesAreWideEnough) {
  int bias = 0, gain = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    const SimulationErrors errors =
        errorsOf(measured(100, kDelay) + autoregressive(100, 0, 0.3, seed), sampled(100, 0));
    bias += holds(errors.bias, kBias);
    gain += holds(errors.gain, kGain);
  }
  EXPECT_GE(bias, 362);
  EXPECT_GE(gain, 362);
}

// The truth is made of the variances of the simulation and of the noise.
TEST(SimulationErrors, TheIntervalOfTheFitHoldsTheTrueOne) {
  const Eigen::VectorXd y_sim = sampled(1000, 0);
  const double power = (y_sim.array() - y_sim.mean()).square().mean(), noise = 0.5 * 0.5;
  const double truth = 100 * (1 - std::sqrt(noise / (power + noise)));
  int held = 0;
  for (unsigned seed = 1; seed <= 400; ++seed)
    held += holds(errorsOf(y_sim + autoregressive(1000, 0.7, 0.5, seed), y_sim).fit, truth);
  EXPECT_GE(held, 362);
  EXPECT_LE(held, 396);
}

TEST(SimulationErrors, MissingSamplesAreNotRead) {
  Eigen::VectorXd y = measured(800, kDelay);
  Eigen::ArrayXd weight = Eigen::ArrayXd::Ones(800);
  for (int k = 0; k < 800; k += 7) {
    y[k] = std::nan("");
    weight[k] = 0;
  }
  const SimulationErrors errors = simulationErrors(y, weight, sampled(800, 0), kStep);
  EXPECT_EQ(errors.samples, 685);
  EXPECT_NEAR(errors.gain.value, kGain, 1e-4);
  EXPECT_NEAR(errors.delay.value, kDelay, 1e-5);
}

TEST(SimulationErrors, AConstantSimulationHasABiasOnly) {
  const Eigen::VectorXd y = measured(800, 0);
  const SimulationErrors errors = errorsOf(y, Eigen::VectorXd::Constant(800, 0.5));
  EXPECT_NEAR(errors.bias.value, y.mean() - 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(errors.gain.value));
  EXPECT_TRUE(std::isnan(errors.delay.value));
  ASSERT_EQ(errors.untold.size(), 1U);
  EXPECT_EQ(errors.untold.front(),
            "Gain and delay error are not told, because the simulation stands still.");
}

TEST(SimulationErrors, ARampTellsNoDelay) {
  const Eigen::VectorXd ramp = Eigen::VectorXd::LinSpaced(400, 0, 4);
  const SimulationErrors errors = errorsOf(2 * ramp + autoregressive(400, 0.5, 0.1, 1), ramp);
  EXPECT_TRUE(holds(errors.gain, 2));
  EXPECT_TRUE(std::isnan(errors.delay.value));
  ASSERT_EQ(errors.untold.size(), 1U);
  EXPECT_NE(errors.untold.front().find("cannot be told apart from gain and bias"),
            std::string::npos);
}

TEST(SimulationErrors, AnOutputThatDoesNotFollowTellsNoDelay) {
  const SimulationErrors errors = errorsOf(autoregressive(400, 0.5, 1, 3), sampled(400, 0));
  EXPECT_TRUE(holds(errors.gain, 0));
  EXPECT_TRUE(std::isnan(errors.delay.value));
  EXPECT_EQ(errors.untold.size(), 1U);
}

TEST(SimulationErrors, TooFewOrInfiniteSamplesTellNothing) {
  EXPECT_TRUE(std::isnan(errorsOf(measured(29, 0), sampled(29, 0)).fit.value));
  Eigen::VectorXd y_sim = sampled(100, 0);
  y_sim[3] = std::nan("");
  const SimulationErrors errors = errorsOf(measured(100, 0), y_sim);
  EXPECT_TRUE(std::isnan(errors.bias.value));
  EXPECT_EQ(errors.untold.size(), 1U);
  EXPECT_FALSE(std::isnan(errorsOf(measured(30, 0), sampled(30, 0)).fit.value));
}

TEST(SimulationErrors, AreThoseOfTheCovariateOfAnExperiment) {
  Experiment experiment;
  experiment.id = "run";
  experiment.sample_time = kStep;
  experiment.y = measured(300, kDelay);
  experiment.u = Eigen::VectorXd::Zero(300);
  EXPECT_FALSE(simulationErrors(experiment, "sim"));
  experiment.signals["sim"] = sampled(300, 0);
  EXPECT_EQ(simulationErrors(experiment, "sim")->id, "run");
  EXPECT_NEAR(simulationErrors(experiment, "sim")->delay.value, kDelay, 1e-4);
  experiment.signals.clear();
  experiment.scalars["sim"] = 0.4;
  EXPECT_NEAR(simulationErrors(experiment, "sim")->bias.value, experiment.y.mean() - 0.4, 1e-9);
}

TEST(SimulationErrors, AreToldInWords) {
  SimulationErrors errors;
  errors.fit = {87.34, 1, 85.1, 89.6};
  errors.bias = {0.4, 0.1, 0.2, 0.6};
  errors.untold = {"Gain and delay error are not told."};
  EXPECT_EQ(describe(errors),
            "The simulation has fit 87.3 % (85.1 to 89.6), bias 0.4 (0.2 to 0.6). Gain and delay "
            "error are not told.");
}

}  // namespace
}  // namespace uncertainty_identification
