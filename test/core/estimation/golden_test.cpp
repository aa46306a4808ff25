// Likelihood, gradient and optimum against numbers that an independent program computed from the
// paper's equations, everything at rest before the first sample.
#include "support/golden.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

class Golden : public testing::TestWithParam<const char*> {
 protected:
  test::Golden golden_ = test::readGolden(GetParam());
  Configuration configuration_ = test::configurationOf(golden_);
  test::CoreSetup setup_{configuration_, golden_.experiments};
};

TEST_P(Golden, LikelihoodValues) {
  auto points = golden_.points;
  points.push_back(golden_.optimum);
  ASSERT_GE(points.size(), 3u);
  for (const auto& point : points) {
    EXPECT_NEAR(setup_.logLikelihood(test::parametersOf(point)), point.log_likelihood,
                1e-9 * std::abs(point.log_likelihood));
  }
}

TEST_P(Golden, Gradients) {
  int checked = 0;
  for (const auto& point : golden_.points) {
    if (point.gradient_theta.size() == 0) continue;
    const ModelParameters at = test::parametersOf(point);
    const Statistics statistics = setup_.likelihood().statistics(at.parameters, true);
    const Eigen::VectorXd all =
        scores(statistics, at, setup_.likelihood().expect(statistics, at)).rowwise().sum();
    const Eigen::VectorXd gradient = all.head(point.theta.size());
    EXPECT_LT((gradient - point.gradient_theta).norm(), 1e-5 * point.gradient_theta.norm())
        << gradient.transpose() << " against " << point.gradient_theta.transpose();
    ++checked;
  }
  EXPECT_GE(checked, 2);
}

TEST_P(Golden, MaximumLikelihoodReachesTheOptimum) {
  const ModelParameters start = test::parametersOf(golden_.start);
  const int passes = setup_.likelihood().passes();
  const Optimum optimum = maximumLikelihood(
      setup_.likelihood(), start, test::optimisationOptions(configuration_, start.mixture, 1e-6));
  EXPECT_EQ(optimum.termination, Termination::converged) << optimum.message;
  EXPECT_GT(optimum.log_likelihood, golden_.optimum.log_likelihood - 1e-5);
  EXPECT_LE(setup_.likelihood().passes() - passes, 100);
  EXPECT_NEAR(optimum.log_likelihood, setup_.logLikelihood(optimum.point), 1e-8);
  EXPECT_LT((optimum.point.parameters - golden_.optimum.theta).norm(),
            1e-3 * golden_.optimum.theta.norm());
}

TEST_P(Golden, ExpectationMaximisationReachesTheOptimum) {
  const ModelParameters start = test::parametersOf(golden_.start);
  const Optimum optimum = expectationMaximisation(
      setup_.likelihood(), start, test::optimisationOptions(configuration_, start.mixture, 1e-9));
  EXPECT_EQ(optimum.termination, Termination::converged) << optimum.message;
  EXPECT_GT(optimum.log_likelihood, golden_.optimum.log_likelihood - 1e-5);
}

TEST_P(Golden, PassesAreCounted) {
  const ModelParameters start = test::parametersOf(golden_.start);
  const int before = setup_.likelihood().passes();
  setup_.likelihood().statistics(start.parameters, true);
  setup_.likelihood().statistics(start.parameters, false);
  EXPECT_EQ(setup_.likelihood().passes(), before + 2);
}

INSTANTIATE_TEST_SUITE_P(Data, Golden, testing::Values("example1", "box_jenkins_2nd_order"));

}  // namespace
}  // namespace uncertainty_identification
