// The paper's Algorithm 1: the likelihood never decreases, the gradient vanishes at the end, and
// the result tells how it ended.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Problem {
  Configuration configuration;
  std::vector<Experiment> experiments;
  ModelParameters start;
};

/// Data of a random system that satisfies the constraint, and a start near the truth.
Problem problemOf(Constraint constraint, int components, int dimension, std::uint64_t seed) {
  test::RandomSystemOptions options;
  options.zero_static_gain = constraint == Constraint::zero_static_gain;
  options.taps = options.zero_static_gain ? dimension + 1 : dimension;
  options.components = components;
  options.experiments = 40;
  options.min_samples = 40;
  options.pole_radius = 0.8;
  auto system = test::randomSystem(options, seed);
  if (constraint == Constraint::zero_mean) {
    const VectorXd mean = system.truth.mixture.mean();
    for (VectorXd& of_component : system.truth.mixture.means) of_component -= mean;
    system = test::simulateSystem(system.truth, options, seed);
  }
  Problem problem{test::configurationOf(options), system.experiments,
                  test::parametersOf(system.truth)};
  problem.configuration.error_model.constraint = constraint;
  ModelParameters& start = problem.start;
  start.parameters *= 0.9;
  start.noise_variance *= 2;
  for (MatrixXd& covariance : start.mixture.covariances) covariance *= 3;
  return problem;
}

void expectMonotone(const Problem& problem, const OptimisationOptions& options) {
  const test::CoreSetup setup(problem.configuration, problem.experiments);
  const Optimum optimum = expectationMaximisation(setup.likelihood(), problem.start, options);
  ASSERT_GE(optimum.trace.size(), 2u);
  ASSERT_EQ(optimum.point.mixture.components(), problem.start.mixture.components()) << "pruned";
  double last = setup.logLikelihood(problem.start);
  for (const TracePoint& point : optimum.trace) {
    EXPECT_GE(point.log_likelihood, last - 1e-9 * std::abs(last))
        << "iteration " << point.iteration;
    last = point.log_likelihood;
  }
  EXPECT_NEAR(setup.logLikelihood(optimum.point), optimum.log_likelihood,
              1e-10 * std::abs(optimum.log_likelihood));
  if (options.constraint == Constraint::zero_mean) {
    EXPECT_LT(optimum.point.mixture.mean().norm(), 1e-8);
  }
}

using Ascent = std::tuple<Constraint, int, int>;

class Monotone : public testing::TestWithParam<Ascent> {};

TEST_P(Monotone, NeverDescends) {
  const auto [constraint, components, dimension] = GetParam();
  for (std::uint64_t seed : {3u, 4u}) {
    const Problem problem = problemOf(constraint, components, dimension, seed);
    OptimisationOptions options =
        test::optimisationOptions(problem.configuration, problem.start.mixture, 1e-12);
    options.max_iterations = 60;
    expectMonotone(problem, options);
  }
}

/// Covariances that are nearly zero or of rank one at the start, without a floor.
TEST_P(Monotone, NeverDescendsNearSingularCovariances) {
  const auto [constraint, components, dimension] = GetParam();
  Problem problem = problemOf(constraint, components, dimension, 5);
  for (MatrixXd& covariance : problem.start.mixture.covariances) {
    covariance = (dimension == 1 ? 1e-9 : 0.3) * MatrixXd::Ones(dimension, dimension);
    covariance.diagonal().array() += 1e-10;
  }
  OptimisationOptions options =
      test::optimisationOptions(problem.configuration, problem.start.mixture, 1e-12);
  options.max_iterations = 40;
  options.floor.setZero();
  expectMonotone(problem, options);
}

INSTANTIATE_TEST_SUITE_P(All, Monotone,
                         testing::Combine(testing::Values(Constraint::zero_static_gain,
                                                          Constraint::zero_mean, Constraint::free),
                                          testing::Values(1, 2, 4), testing::Values(1, 2)));

TEST(ExpectationMaximisation, IsMonotoneWithTheNuisancesOfRealRecords) {
  Problem problem = problemOf(Constraint::zero_static_gain, 2, 1, 6);
  for (Experiment& experiment : problem.experiments) {
    experiment.valid.assign(static_cast<std::size_t>(experiment.samples()), 1);
    for (int k = 9; k < experiment.samples(); k += 7) {
      experiment.valid[static_cast<std::size_t>(k)] = 0;
    }
  }
  problem.configuration.estimation.initial_state = InitialState::estimate;
  problem.configuration.estimation.noise_start = NoiseStart::stationary;
  problem.configuration.estimation.offsets = Offsets::estimate;
  problem.start.parameters = test::appended(problem.start.parameters, 0.5);
  OptimisationOptions options =
      test::optimisationOptions(problem.configuration, problem.start.mixture, 1e-12);
  options.max_iterations = 60;
  expectMonotone(problem, options);
}

TEST(ExpectationMaximisation, EndsWhereTheGradientVanishes) {
  const Problem problem = problemOf(Constraint::zero_static_gain, 2, 1, 3);
  const test::CoreSetup setup(problem.configuration, problem.experiments);
  const Optimum optimum = expectationMaximisation(
      setup.likelihood(), problem.start,
      test::optimisationOptions(problem.configuration, problem.start.mixture, 1e-9));
  EXPECT_EQ(optimum.termination, Termination::converged);
  EXPECT_EQ(optimum.iterations, static_cast<int>(optimum.trace.size()));
  EXPECT_GT(optimum.trace.front().step->norm, optimum.trace.back().step->norm);
  EXPECT_GT(optimum.trace.front().step->gradient_norm, optimum.trace.back().step->gradient_norm);
  const Statistics statistics = setup.likelihood().statistics(optimum.point.parameters, true);
  const Expectation e = setup.likelihood().expect(statistics, optimum.point);
  const MatrixXd all = scores(statistics, optimum.point, e);
  const VectorXd gradient = all.rowwise().sum(), size = all.rowwise().norm();
  for (Eigen::Index j = 0; j < gradient.size(); ++j) {
    const bool weight =
        j >= optimum.point.parameters.size() && j < optimum.point.parameters.size() + 2;
    const double vanishing = gradient[j] - (weight ? 40.0 : 0.0);  // sum of weights is kept
    EXPECT_LT(std::abs(vanishing), 1e-3 * size[j]) << "coordinate " << j;
  }
}

TEST(ExpectationMaximisation, SaysHowItEnded) {
  const Problem problem = problemOf(Constraint::zero_static_gain, 2, 1, 3);
  const test::CoreSetup setup(problem.configuration, problem.experiments);
  OptimisationOptions options =
      test::optimisationOptions(problem.configuration, problem.start.mixture, 1e-12);
  options.max_iterations = 3;
  const Optimum limited = expectationMaximisation(setup.likelihood(), problem.start, options);
  EXPECT_EQ(limited.termination, Termination::iteration_limit);
  EXPECT_EQ(limited.iterations, 3);
  EXPECT_NE(limited.message.find("max_iterations"), std::string::npos);
  options.on_iterate = [](const TracePoint& point) { return point.iteration < 2; };
  const Optimum cancelled = expectationMaximisation(setup.likelihood(), problem.start, options);
  EXPECT_EQ(cancelled.termination, Termination::cancelled);
  EXPECT_EQ(cancelled.iterations, 2);
}

/// A component that explains no experiment is removed, and the optimisation continues.
TEST(ExpectationMaximisation, PrunesEmptyComponents) {
  Problem problem = problemOf(Constraint::zero_static_gain, 2, 1, 3);
  Mixture& mixture = problem.start.mixture;
  mixture.weights = {0.5, 0.49, 0.01};
  mixture.means.push_back(VectorXd::Constant(1, 40));
  mixture.covariances.push_back(MatrixXd::Constant(1, 1, 0.01));
  const test::CoreSetup setup(problem.configuration, problem.experiments);
  const Optimum optimum =
      expectationMaximisation(setup.likelihood(), problem.start,
                              test::optimisationOptions(problem.configuration, mixture, 1e-7));
  EXPECT_EQ(optimum.point.mixture.components(), 2);
  EXPECT_EQ(optimum.termination, Termination::converged);
  EXPECT_NEAR(optimum.point.mixture.weights[0] + optimum.point.mixture.weights[1], 1, 1e-12);
}

}  // namespace
}  // namespace uncertainty_identification
