// Readings that a sensor of coarse steps holds in gaps, and rests that look alike.
#include "explanation/held_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "explanation/masked_samples.h"

namespace uncertainty_identification {
namespace {

/// An experiment of 500 samples whose input changes at each.
Experiment drivenByNoise() {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  Experiment experiment;
  experiment.sample_time = 0.1;
  experiment.u.resize(500);
  for (int t = 0; t < 500; ++t) experiment.u[t] = normal(engine);
  experiment.y = Eigen::VectorXd::Zero(500);
  return experiment;
}

/// A motor that turns to and fro, read in hundredths; from each 50th sample on, `lost` readings are
/// the last one again. `sticks`: meanwhile the motor stands still.
std::vector<Experiment> motorReadInSteps(int lost, bool sticks) {
  std::vector<Experiment> one{drivenByNoise()};
  double angle = 0;
  for (int t = 0; t < 500; ++t) {
    const bool is_lost = t % 50 < lost && t >= 50;
    angle += is_lost && sticks ? 0 : 0.3 * std::sin(0.061 * t + 1);
    one[0].y[t] = is_lost ? one[0].y[t - 1] : std::round(100 * angle) / 100;
  }
  return one;
}

void expectNoneHeld(const std::vector<Experiment>& experiments, const char* what) {
  for (const SpoiltSamples& each : checkSamples(experiments))
    EXPECT_NE(each.trait, Trait::held_samples) << what;
}

TEST(HeldSamples, AreSeenInGapsOfASensorOfCoarseSteps) {
  std::vector<Experiment> experiments = motorReadInSteps(6, false);
  const auto found = checkSamples(experiments);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].trait, Trait::quantisation);
  EXPECT_EQ(found[1].trait, Trait::held_samples);
  EXPECT_NEAR(found[1].parameters.at(0).value, 9 * 6 / 500.0, 0.03);
  experiments[0].y.tail(20).setConstant(experiments[0].y[480]);  // a rest, which is no gap
  const std::vector<Experiment> kept = withoutSpoiled(experiments, found[1]);
  EXPECT_FALSE(kept[0].isValid(103));
  EXPECT_TRUE(kept[0].isValid(490));
  expectNoneHeld(motorReadInSteps(6, true), "it stands still");
  expectNoneHeld(motorReadInSteps(2, false), "two repeats");
}

/// A fast plant settles within few samples, and waits for the next step of its input.
TEST(HeldSamples, AreNoneOfAPlantThatSettlesBetweenSteps) {
  std::mt19937_64 engine(9);
  std::normal_distribution<double> normal;
  for (const double pole : {0.1, 0.2, 0.3, 0.4})
    for (const int hold : {6, 8, 12})
      for (const double size : {4.0, 10.0, 100.0}) {
        std::vector<Experiment> stairs{drivenByNoise()};
        double x = 0;
        for (int t = 0; t < 500; ++t) {
          stairs[0].u[t] = t % hold == 0 ? size * normal(engine) : stairs[0].u[t - 1];
          stairs[0].y[t] = std::round(x);
          x = pole * x + (1 - pole) * stairs[0].u[t];
        }
        expectNoneHeld(stairs, "it rests");
      }
}

/// A motor that runs to and fro, and reverses in many of the gaps.
TEST(HeldSamples, AreSeenOfAMachineThatReversesInTheGaps) {
  std::mt19937_64 engine(2);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<Experiment> motor{drivenByNoise()};
  double x = 0, sign = 1;
  int lost = 0;
  for (int t = 0; t < 500; ++t) {
    if (uniform(engine) < 0.2) sign = -sign;
    motor[0].u[t] = sign;
    if (lost == 0 && uniform(engine) < 0.04) lost = 12;
    motor[0].y[t] = lost > 0 && t > 0 ? motor[0].y[t - 1] : x + 0.002 * normal(engine);
    lost = std::max(0, lost - 1);
    x = 0.84 * x + 0.16 * sign;
  }
  const auto found = checkSamples(motor);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].trait, Trait::held_samples);
}

}  // namespace
}  // namespace uncertainty_identification
