// How probable a cause is among the effects that were tried.
#include "explanation/confidence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace uncertainty_identification {
namespace {

Evidence scored(double score) { return {score, {}}; }

/// The same gain in each of ten experiments, but for a deviation that alternates.
Evidence measured(double gain, double deviation) {
  Evidence evidence;
  evidence.gains.resize(10);
  for (int r = 0; r < 10; ++r) evidence.gains[r] = gain + (r % 2 == 0 ? deviation : -deviation);
  evidence.score = evidence.gains.sum();
  return evidence;
}

TEST(Confidence, IsThePosteriorProbabilityAmongTheCandidates) {
  EXPECT_NEAR(confidenceOf(scored(10), {scored(9)}), 1 / (1 + std::exp(-1.0)), 1e-12);
  EXPECT_EQ(confidenceOf(scored(10), {}), 1);
}

TEST(Confidence, IsNearlyNothingBehindAnotherByFar) {
  EXPECT_LT(confidenceOf(scored(10), {scored(80)}), 1e-20);
}

/// The lead is 20 nats in both cases. Where the experiments disagree, its standard error is 10.5
/// nats, which is z = 1.9 and a probability of 97 %.
TEST(Confidence, IsNoSurerThanTheExperimentsAgree) {
  const Evidence chosen = measured(5, 0);
  EXPECT_GT(confidenceOf(chosen, {measured(3, 0.01)}), 0.999999);
  const double unsure = confidenceOf(chosen, {measured(3, std::sqrt(10.0))});
  EXPECT_NEAR(unsure, 0.971, 0.002);
}

TEST(Confidence, DoesNotRiseWhereTheExperimentsDisagree) {
  EXPECT_NEAR(confidenceOf(measured(3, 3), {measured(5, 0)}), std::exp(-20.0), 1e-9);
}

TEST(Confidence, OfAFewExperimentsIsThatOfTheScoresButNeverHigh) {
  Evidence chosen = scored(11), rival = scored(10);
  chosen.gains = Eigen::Vector3d(8, 1, 2);
  rival.gains = Eigen::Vector3d(2, 6, 2);
  EXPECT_NEAR(confidenceOf(chosen, {rival}), 1 / (1 + std::exp(-1.0)), 1e-12);
  chosen.score = 30;
  EXPECT_EQ(confidenceOf(chosen, {rival}), 0.8);
  EXPECT_EQ(confidenceOf(chosen, {}), 0.8);
}

}  // namespace
}  // namespace uncertainty_identification
