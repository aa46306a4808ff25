// Limits within a plant that is itself a control loop, such as a position servo.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "curves/explain_simulation.h"

namespace uncertainty_identification {
namespace {

constexpr double kLoopGain = 0.25;  // [1/sample]

/// Runs of a servo that goes to offset + gain u, by at most `limit` a sample. The input makes steps
/// of different sizes.
std::vector<Experiment> ofAServo(double limit, int count, double gain = 1, double offset = 0) {
  constexpr int kSamples = 300;
  std::vector<Experiment> all(static_cast<std::size_t>(count));
  for (std::size_t r = 0; r < all.size(); ++r) {
    std::mt19937_64 engine(r + 5);
    std::normal_distribution<double> normal;
    Experiment& run = all[r];
    run.id = "run " + std::to_string(r);
    run.sample_time = 0.02;
    run.u.resize(kSamples);
    run.y.resize(kSamples);
    double x = offset, level = 0;
    for (int k = 0; k < kSamples; ++k) {
      if (k % 37 == 5) level = static_cast<double>(engine() % 401) / 100 - 2;
      run.u[k] = level;
      run.y[k] = x + 0.01 * normal(engine);
      x += std::clamp(kLoopGain * (offset + gain * level - x), -limit, limit);
    }
  }
  return all;
}

SimulationCauses explainedServo(const std::vector<Experiment>& runs) {
  WorkerPool pool(1);
  const auto held = runs.end() - 2;
  return explainSimulation({runs.begin(), held}, {held, runs.end()}, {}, &pool);
}

TEST(LoopError, NamesTheLimitOfAServo) {
  constexpr double kLimit = 0.1;
  const SimulationCauses found = explainedServo(ofAServo(kLimit, 5));
  ASSERT_FALSE(found.causes.empty());
  const SimulationCause& cause = found.causes.front();
  EXPECT_EQ(cause.what.name, "act_saturation");
  EXPECT_EQ(cause.what.place, "loop_error");
  ASSERT_FALSE(cause.values.empty());
  const ShapeValue& limit = cause.values.back();
  EXPECT_EQ(limit.name, "limit");
  EXPECT_NEAR(limit.value, kLimit / kLoopGain, std::max(3 * limit.standard_error, 0.02));
  EXPECT_GT(found.fit_after, 98);
}

/// A limit is told in units of the input.
TEST(LoopError, NamesTheLimitWhereTheOutputHasAnotherUnitSignAndZero) {
  constexpr double kLimit = 0.2, kGain = -2;
  const SimulationCauses found = explainedServo(ofAServo(kLimit, 5, kGain, 13));
  ASSERT_FALSE(found.causes.empty());
  const SimulationCause& cause = found.causes.front();
  EXPECT_EQ(cause.what.place, "loop_error");
  ASSERT_FALSE(cause.values.empty());
  for (const ShapeValue& limit : cause.values)
    EXPECT_NEAR(std::abs(limit.value), kLimit / kLoopGain / std::abs(kGain),
                std::max(3 * limit.standard_error, 0.02));
}

TEST(LoopError, NamesNothingInAServoThatDoesNotReachItsLimit) {
  EXPECT_TRUE(explainedServo(ofAServo(10, 5)).causes.empty());
}

}  // namespace
}  // namespace uncertainty_identification
