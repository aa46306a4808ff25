// Which records show that the system was at rest before they began.
#include "curves/rest_before.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace uncertainty_identification {
namespace {

/// A plant of first order from `from` on: the input is 0 for `still` samples and `level` then.
Experiment step(double from, int still, double level, double noise = 0, unsigned seed = 1) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Experiment run;
  run.u = Eigen::VectorXd::Constant(100, level);
  run.u.head(still).setZero();
  run.y.resize(100);
  double y = from;
  for (int k = 0; k < 100; ++k) {
    run.y[k] = y + noise * normal(engine);
    y = 0.9 * y + 0.1 * run.u[k];
  }
  return run;
}

TEST(RestBefore, AnOutputThatStandsStillUntilTheInputMoves) {
  const RestBefore rest({});
  const auto exact = rest.of(step(0, 3, 2));
  ASSERT_TRUE(exact.has_value());
  EXPECT_EQ(exact->u, 0);
  EXPECT_EQ(exact->y, 0);
  const auto noisy = rest.of(step(0, 30, 2, 0.02));
  ASSERT_TRUE(noisy.has_value());
  EXPECT_NEAR(noisy->y, 0, 4 * 0.02 / std::sqrt(30.0));
  EXPECT_FALSE(rest.of(step(0, 1, 2, 0.02)).has_value()) << "nothing is seen before the step";
}

TEST(RestBefore, NoOutputThatMovesBeforeTheInputDoes) {
  const RestBefore rest({});
  EXPECT_FALSE(rest.of(step(1, 3, 2)).has_value());
  EXPECT_FALSE(rest.of(step(1, 30, 2, 0.02)).has_value());
}

TEST(RestBefore, StepsFromTheFirstSampleOnThatBeginAtOneLevel) {
  const std::vector<Experiment> steps{step(20, 0, 22), step(20, 0, 30), step(20, 0, 25)};
  const auto found = RestBefore(steps).of(steps[1]);
  EXPECT_FALSE(found.has_value()) << "an input of zero is far from all inputs";
  std::vector<Experiment> from_zero{step(0, 0, 22), step(0, 0, 30), step(0, 0, 25)};
  const auto at_zero = RestBefore(from_zero).of(from_zero[1]);
  ASSERT_TRUE(at_zero.has_value());
  EXPECT_EQ(at_zero->u, 0);
  EXPECT_EQ(at_zero->y, 0);
  from_zero[2] = step(15, 0, 25);
  EXPECT_FALSE(RestBefore(from_zero).of(from_zero[1]).has_value()) << "one begins elsewhere";
  from_zero.pop_back();
  EXPECT_FALSE(RestBefore(from_zero).of(from_zero[1]).has_value()) << "two may be chance";
}

TEST(RestBefore, OfManyStepsTheInitialStateStandsForLittle) {
  Experiment many = step(0, 10, 2);
  ASSERT_TRUE(RestBefore({}).of(many).has_value());
  for (int k = 20; k < 100; k += 20) many.u.segment(k, 10).setConstant(1);
  EXPECT_FALSE(RestBefore({}).of(many).has_value());
}

TEST(RestBefore, OfInputsThatMoveTheFirstOutputSaysNothing) {
  std::vector<Experiment> runs{step(0, 0, 22), step(0, 0, 30), step(0, 0, 25)};
  for (Experiment& run : runs) run.u.tail(50) *= 0.5;
  EXPECT_FALSE(RestBefore(runs).of(runs[0]).has_value());
}

}  // namespace
}  // namespace uncertainty_identification
