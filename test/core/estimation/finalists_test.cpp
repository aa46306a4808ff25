// Starts climb together only until it is known which of them leads highest.
#include "estimation/finalists.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

Finalist evaluatedAt(const test::CoreSetup& setup, const ModelParameters& point) {
  return {point, setup.logLikelihood(point)};
}

class Finalists : public testing::Test {
 protected:
  test::RandomSystem system_ = test::example1(3, 40);
  test::CoreSetup setup_{test::example1Configuration(), system_.experiments};
  ModelParameters truth_ = test::parametersOf(system_.truth);
  OptimisationOptions options_ =
      test::optimisationOptions(test::example1Configuration(), truth_.mixture, 1e-6);
};

TEST_F(Finalists, ThoseThatMeetCountOnce) {
  ModelParameters near = truth_;
  near.parameters *= 0.97;
  const auto left = climbTogether(
      setup_.likelihood(), {evaluatedAt(setup_, near), evaluatedAt(setup_, truth_)}, options_, 10);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_NEAR(left[0].log_likelihood, setup_.logLikelihood(left[0].point), 1e-6);
  const Optimum optimum = maximumLikelihood(setup_.likelihood(), truth_, options_);
  EXPECT_NEAR(left[0].log_likelihood, optimum.log_likelihood, 0.01);
}

TEST_F(Finalists, TheHighestComesFirst) {
  ModelParameters far = truth_;
  far.parameters << -1, -0.9, 0.1, -0.9;
  const auto left = climbTogether(
      setup_.likelihood(), {evaluatedAt(setup_, far), evaluatedAt(setup_, truth_)}, options_, 40);
  const Optimum optimum = maximumLikelihood(setup_.likelihood(), truth_, options_);
  ASSERT_FALSE(left.empty());
  EXPECT_NEAR(left[0].log_likelihood, optimum.log_likelihood, 0.01);
  for (std::size_t k = 1; k < left.size(); ++k)
    EXPECT_LT(left[k].log_likelihood, left[k - 1].log_likelihood);
}

TEST_F(Finalists, AreNoneWhereTheLikelihoodIsNowhereFinite) {
  ModelParameters nowhere = truth_;
  nowhere.noise_variance = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(
      climbTogether(setup_.likelihood(), {evaluatedAt(setup_, nowhere)}, options_, 3).empty());
  EXPECT_TRUE(climbTogether(setup_.likelihood(), {}, options_, 3).empty());
}

}  // namespace
}  // namespace uncertainty_identification
