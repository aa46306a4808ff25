#include "estimation/initial_guess.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/core_setup.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

class Example1 : public testing::TestWithParam<std::uint64_t> {};

/// Without a given start the identification ends at the optimum that is reached from the truth.
TEST_P(Example1, AutomaticStartReachesTheOptimumNextToTheTruth) {
  const auto system = test::example1(GetParam());
  const Configuration configuration = test::example1Configuration();
  const test::CoreSetup setup(configuration, system.experiments);
  const ModelParameters truth = test::parametersOf(system.truth);
  const Optimum from_truth = maximumLikelihood(
      setup.likelihood(), truth, test::optimisationOptions(configuration, truth.mixture, 1e-7));
  ASSERT_EQ(from_truth.termination, Termination::converged);
  const Estimate estimate = Identifier(configuration).identify(system.experiments);
  EXPECT_EQ(estimate.termination, Termination::converged) << estimate.message;
  EXPECT_GT(estimate.log_likelihood, from_truth.log_likelihood - 1e-4);
}

INSTANTIATE_TEST_SUITE_P(DataSets, Example1, testing::Values(1, 2, 3, 4, 5, 6));

TEST(NominalStarts, AreAdmissibleAndNearTheTruth) {
  const auto system = test::example1(3);
  const Configuration configuration = test::example1Configuration();
  const test::CoreSetup setup(configuration, system.experiments);
  const auto starts = nominalStarts(setup.model(), configuration.nominal_model, system.experiments);
  ASSERT_FALSE(starts.empty());
  for (const VectorXd& start : starts) {
    ASSERT_EQ(start.size(), 4);
    EXPECT_TRUE(setup.model().admissible(start));
  }
  const std::optional<ModelParameters> best = bestSingleComponent(
      setup.likelihood(), starts, test::optimisationOptions(configuration, {}, 1e-6));
  ASSERT_TRUE(best.has_value());
  EXPECT_EQ(best->mixture.components(), 1);
  EXPECT_LT((best->parameters - test::parametersOf(system.truth).parameters).norm(), 0.1)
      << best->parameters.transpose();
}

TEST(BestSingleComponent, IsAbsentWithoutAStart) {
  const auto system = test::example1(3);
  const test::CoreSetup setup(test::example1Configuration(), system.experiments);
  EXPECT_FALSE(bestSingleComponent(setup.likelihood(), {}, OptimisationOptions()).has_value());
}

TEST(NominalStarts, HoldTheOffset) {
  auto system = test::example1(3, 20);
  for (Experiment& experiment : system.experiments) experiment.y.array() += 5;
  Configuration configuration = test::example1Configuration();
  configuration.estimation.offsets = Offsets::estimate;
  const test::CoreSetup setup(configuration, system.experiments);
  const auto starts = nominalStarts(setup.model(), configuration.nominal_model, system.experiments);
  ASSERT_FALSE(starts.empty());
  EXPECT_NEAR(starts[0][4], 5, 0.5);
}

/// A start must be found also for few experiments of different length with gaps.
TEST(NominalStarts, AreFoundForShortAndSpoiledRecords) {
  test::RandomSystemOptions options;
  options.na = options.nb = options.nc = options.nd = 2;
  options.experiments = 5;
  options.min_samples = 25;
  options.missing = 0.3;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto system = test::randomSystem(options, seed);
    const Configuration configuration = test::configurationOf(options);
    const test::CoreSetup setup(configuration, system.experiments);
    const auto starts =
        nominalStarts(setup.model(), configuration.nominal_model, system.experiments);
    EXPECT_FALSE(starts.empty()) << seed;
    for (const VectorXd& start : starts) EXPECT_TRUE(setup.model().admissible(start));
  }
}

TEST(SpreadComponents, FindsTheTwoComponentsOfExample1) {
  const auto system = test::example1(3);
  const Configuration configuration = test::example1Configuration();
  const test::CoreSetup setup(configuration, system.experiments);
  ModelParameters single = test::parametersOf(system.truth);
  single.mixture = {{1.0}, {system.truth.mixture.mean()}, {system.truth.mixture.covariance()}};
  const Statistics statistics = setup.likelihood().statistics(single.parameters, false);
  const int passes = setup.likelihood().passes();
  double reached = 0;
  const ModelParameters two =
      spreadComponents(setup.likelihood(), statistics, single, 2, 4, 1,
                       test::optimisationOptions(configuration, single.mixture, 1e-6), &reached);
  EXPECT_EQ(setup.likelihood().passes(), passes) << "no sweep is needed";
  ASSERT_EQ(two.mixture.components(), 2);
  EXPECT_NEAR(reached, setup.logLikelihood(two), 1e-8);
  EXPECT_GT(reached, setup.logLikelihood(single) + 10);
  EXPECT_NEAR(std::abs(two.mixture.means[0][0] - two.mixture.means[1][0]), 2, 0.4);
}

/// Three experiments cannot fill two components: every start has the penalty.
TEST(SpreadComponents, TakesAPenaltyForComponentsOfFewerThanTwoExperiments) {
  const auto system = test::example1(3, 3);
  const Configuration configuration = test::example1Configuration();
  const test::CoreSetup setup(configuration, system.experiments);
  ModelParameters single = test::parametersOf(system.truth);
  single.mixture = {{1.0}, {system.truth.mixture.mean()}, {system.truth.mixture.covariance()}};
  const Statistics statistics = setup.likelihood().statistics(single.parameters, false);
  double reached = 0;
  const ModelParameters two =
      spreadComponents(setup.likelihood(), statistics, single, 2, 4, 1,
                       test::optimisationOptions(configuration, single.mixture, 1e-6), &reached);
  EXPECT_GE(smallComponentPenalty(two.mixture, 3), 1000);
  EXPECT_NEAR(reached + smallComponentPenalty(two.mixture, 3), setup.logLikelihood(two), 1e-8);
}

}  // namespace
}  // namespace uncertainty_identification
