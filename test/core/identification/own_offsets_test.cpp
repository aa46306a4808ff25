// A heated tank whose flow differs from run to run, which moves its gain and its slow time constant
// together, while the inlet is colder on some days. Simulated here, in small steps.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

constexpr double kTankStep = 30, kReading = 0.03, kFlows = 0.12,
                 kHeating = 2.4;  // [s], [K], -, [K/kW]

class HeatedTanks : public testing::Test {
 protected:
  /// Heater [kW], about 20, to outlet temperature [degC]; from the steady state on.
  Experiment measured(int number, int samples) {
    const double flow = std::exp(kFlows * normal()), inlet = 15 + 0.5 * normal();
    const double lags[] = {60, 1200 / flow, 40};
    double heater = 20, state[] = {heater, kHeating * heater / flow, kHeating * heater / flow};
    Experiment one;
    one.id = "tank_" + std::to_string(number);
    one.sample_time = kTankStep;
    one.u.resize(samples);
    one.y.resize(samples);
    for (int t = 0, next = 6; t < samples; ++t) {
      if (t == next) {
        heater = 20 + 2 * std::round(2.5 * normal());
        next += 20 + static_cast<int>(20 * std::abs(normal()));
      }
      one.u[t] = heater;
      one.y[t] = inlet + state[2] + kReading * normal();
      constexpr int kParts = 300;
      for (int part = 0; part < kParts; ++part) {
        const double h = kTankStep / kParts;
        state[2] += h / lags[2] * (state[1] - state[2]);
        state[1] += h / lags[1] * (kHeating / flow * state[0] - state[1]);
        state[0] += h / lags[0] * (heater - state[0]);
      }
    }
    return one;
  }

 private:
  double normal() { return std::normal_distribution<double>()(random_); }

  std::mt19937_64 random_{1};
};

// Simple models see the levels as what differing gains or a wandering noise do to them. With noise
// that wanders as long as the runs last, the simulation of the mean plant stays at a common level.
TEST_F(HeatedTanks, HaveLevelsOfTheirOwnInsteadOfNoiseThatLasts) {
  std::vector<Experiment> tanks;
  for (int k = 0; k < 10; ++k) tanks.push_back(measured(k, 180));
  const Estimate found = Identifier(Configuration()).identify(tanks);
  EXPECT_EQ(found.configuration.estimation.offsets, Offsets::per_experiment);
  EXPECT_GT(found.simulation_fit_percent, 85);
  // Two fast lags, and not a delay in their place. The standard deviation of 1,800 readings has a
  // standard error of 2 %.
  EXPECT_EQ(found.nominal_model.delay, 1);
  EXPECT_EQ(found.nominal_model.a.size(), 3);
  EXPECT_NEAR(std::sqrt(found.noise_variance.value), kReading, 0.06 * kReading);
  // The mean of ten flows lies within three standard errors.
  const double gain = found.nominal_model.b.sum() / (1 + found.nominal_model.a.sum());
  EXPECT_NEAR(gain, kHeating, 3 * kFlows * kHeating / std::sqrt(10));
}

/// Five first-order plants whose gains differ by 8 %, at levels that differ by more than what the
/// input does to them.
std::vector<Experiment> plantsAtLevels(unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> between(2, 8);
  std::vector<Experiment> all(5);
  for (Experiment& experiment : all) {
    experiment.id = "run_" + std::to_string(&experiment - all.data());
    experiment.sample_time = 0.1;
    experiment.u.resize(400);
    experiment.y.resize(400);
    const double gain = 1 + 0.08 * normal(random), level = 3 * normal(random);
    double x = 5, u = 0;
    for (int k = 0; k < 400; ++k) {
      if (k % 20 == 0) u = between(random);
      experiment.u[k] = u;
      experiment.y[k] = level + x + 0.05 * normal(random);
      x += 0.1 * (gain * u - x);
    }
  }
  return all;
}

// The orders are chosen beside the offsets: starts that do not know of levels of their own end far
// from the plant, and high orders follow.
TEST(OwnOffsets, LeaveTheOrderOfThePlantToBeFound) {
  for (const unsigned seed : {5U, 19U, 49U}) {
    const Estimate found = Identifier(Configuration()).identify(plantsAtLevels(seed));
    EXPECT_EQ(found.configuration.estimation.offsets, Offsets::per_experiment) << seed;
    ASSERT_EQ(found.nominal_model.a.size(), 1) << seed;
    EXPECT_NEAR(found.nominal_model.a[0], -0.9, 0.005) << seed;
    // The mean of five gains has a standard deviation of 0.08/sqrt(5) = 0.036.
    EXPECT_NEAR(found.nominal_model.b.sum() / 0.1, 1, 0.12) << seed;
    EXPECT_TRUE(found.trust.trusted) << seed;
  }
}

/// Six blocks heated about 50 %, where all are at 136 degC, whose gains differ by 20 %; the noise
/// is coloured.
std::vector<Experiment> blocksAboutAPoint(unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> hold(5, 60);
  std::vector<Experiment> all(6);
  for (Experiment& experiment : all) {
    experiment.id = "block_" + std::to_string(&experiment - all.data());
    experiment.sample_time = 25;
    experiment.u.resize(720);
    experiment.y.resize(720);
    const double gain = 2.6 * (1 + 0.2 * normal(random));
    double x = 0, noise = 0, heater = 23;
    for (int t = 0, next = 0; t < 720; ++t) {
      if (t == next) {
        heater = normal(random) < 0.5 ? -heater : heater;
        next += hold(random);
      }
      noise = 0.7 * noise + 0.7 * normal(random);
      experiment.u[t] = 50 + heater;
      experiment.y[t] = 136 + gain * x + noise;
      x += 0.05 * (heater - x);
    }
  }
  return all;
}

// No mean plant simulates levels of their own as well as the one that all pass through. A common
// level leaves the rest to the noise, whose tests then fail.
TEST(OwnOffsets, AreTakenWhereGainsDifferAboutAPoint) {
  for (const unsigned seed : {1U, 15U}) {
    const Estimate found = Identifier(Configuration()).identify(blocksAboutAPoint(seed));
    EXPECT_EQ(found.configuration.estimation.offsets, Offsets::per_experiment) << seed;
    EXPECT_GT(found.residual_tests.whiteness_p_value, 1e-3) << seed;
    EXPECT_GT(found.residual_tests.linearity_p_value, 1e-3) << seed;
    // Six gains determine their standard deviation by a third.
    EXPECT_NEAR(std::sqrt(found.error_model.mixture.covariance()(0, 0)), 0.2, 0.15) << seed;
  }
}

/// Runs of a first-order plant whose time constant differs by 15 %. Each starts at rest, and its
/// sensor has an offset that is larger than what the input does.
std::vector<Experiment> plantsAtRest(unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Experiment> all(12);
  for (Experiment& experiment : all) {
    experiment.id = "run_" + std::to_string(&experiment - all.data());
    experiment.sample_time = 0.1;
    experiment.u.resize(300);
    experiment.y.resize(300);
    const double rate = 0.1 / (1 + 0.15 * normal(random)), offset = -1 + 0.6 * normal(random);
    double x = 0;
    for (int k = 0; k < 300; ++k) {
      experiment.u[k] = k % 2 == 0 ? (random() % 2 == 0 ? 0.5 : -0.5) : experiment.u[k - 1];
      experiment.y[k] = offset + x + 0.02 * normal(random);
      x += rate * (experiment.u[k] - x);
    }
  }
  return all;
}

TEST(OwnOffsets, AreTakenWhereEachRunStartsAtRestAtALevelOfItsOwn) {
  for (const unsigned seed : {2U, 7U}) {
    const Estimate found = Identifier(Configuration()).identify(plantsAtRest(seed));
    EXPECT_EQ(found.configuration.estimation.offsets, Offsets::per_experiment) << seed;
    EXPECT_GT(found.simulation_fit_percent, 80) << seed;
    EXPECT_TRUE(found.trust.trusted) << seed;
  }
}

}  // namespace
}  // namespace uncertainty_identification
