#include "explanation/bootstrap.h"

#include <gtest/gtest.h>

#include "estimation/initial_guess.h"
#include "support/fit_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;

/// A fit of one component to Example 1, and the gain of log-likelihood by a second one.
struct OneOfTwo {
  Fit one;
  FitData data;
  double ratio;
};

OneOfTwo judged(double distance, const FitContext& context) {
  test::RandomSystem system = test::example1(1, 40);
  system.truth.mixture.means = {test::vectorOf({-distance}), test::vectorOf({distance})};
  system.truth.mixture.covariances = {MatrixXd::Constant(1, 1, 0.04),
                                      MatrixXd::Constant(1, 1, 0.04)};
  test::RandomSystemOptions options;
  options.experiments = 40;
  options.min_samples = options.max_samples = 100;
  system = test::simulateSystem(system.truth, options, 6);
  const FitData data = test::example1Data(system.experiments);
  dense::Model truth = system.truth;
  truth.mixture = {{1.0}, {system.truth.mixture.mean()}, {system.truth.mixture.covariance()}};
  const Fit start = test::fitOfTruth(truth, test::example1Configuration(), data);
  const Fit one = mixtureFitted(start.model, start.at, data, context.options, 50);
  const Likelihood likelihood(*one.model, data.blocks(), data.count(), 1);
  double reached = 0;
  OptimisationOptions with_floor = context.options;
  with_floor.floor = covarianceFloor(one.at.mixture);
  spreadComponents(likelihood, likelihood.statistics(one.at.parameters, false), one.at, 2, 4, 1,
                   with_floor, &reached);
  return {one, data, reached - one.log_likelihood};
}

FitContext contextOn(WorkerPool* pool) {
  FitContext context;
  context.pool = pool;
  context.going_on = [] { return true; };
  return context;
}

TEST(Bootstrap, TellsTwoComponentsFromOne) {
  WorkerPool pool(1);
  const FitContext context = contextOn(&pool);
  const OneOfTwo apart = judged(1, context), together = judged(0, context);
  EXPECT_GT(apart.ratio, 10);
  EXPECT_TRUE(exceedsSimulatedRatios(apart.one, apart.data, context, apart.ratio));
  EXPECT_FALSE(exceedsSimulatedRatios(together.one, together.data, context, together.ratio));
}

TEST(Bootstrap, DoesNotDependOnThreads) {
  WorkerPool one(1), two(2);
  const OneOfTwo together = judged(0, contextOn(&one));
  for (const double ratio : {0.5, 1.0, 2.0, 3.0, 4.0, 5.0})
    EXPECT_EQ(exceedsSimulatedRatios(together.one, together.data, contextOn(&one), ratio),
              exceedsSimulatedRatios(together.one, together.data, contextOn(&two), ratio));
}

}  // namespace
}  // namespace uncertainty_identification
