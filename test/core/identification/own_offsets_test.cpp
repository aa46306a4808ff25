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

}  // namespace
}  // namespace uncertainty_identification
