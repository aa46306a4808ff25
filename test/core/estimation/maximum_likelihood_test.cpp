// The quasi-Newton optimisation finds the same optimum as Algorithm 1 in few sweeps, and tells how
// it ended.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <tuple>

#include "estimation/observed_information.h"
#include "estimation/scoring.h"
#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct LikelihoodProblem {
  Configuration configuration;
  std::vector<Experiment> experiments;
  ModelParameters start;
};

LikelihoodProblem problemOf(Constraint constraint, bool real_records) {
  test::RandomSystemOptions options;
  options.nb = options.na = 2;
  options.zero_static_gain = constraint == Constraint::zero_static_gain;
  options.pole_radius = 0.8;
  options.experiments = 40;
  if (real_records) options.noise_run_up = options.input_run_up = 200;
  auto system = test::randomSystem(options, 14);
  if (constraint == Constraint::zero_mean) {
    const VectorXd mean = system.truth.mixture.mean();
    for (VectorXd& of_component : system.truth.mixture.means) of_component -= mean;
    system = test::simulateSystem(system.truth, options, 15);
  }
  LikelihoodProblem problem{test::configurationOf(options), system.experiments,
                            test::parametersOf(system.truth)};
  problem.configuration.error_model.constraint = constraint;
  problem.start.parameters *= 0.9;
  problem.start.noise_variance *= 2;
  if (!real_records) return problem;
  problem.configuration.estimation.initial_state = InitialState::estimate;
  problem.configuration.estimation.noise_start = NoiseStart::stationary;
  problem.configuration.estimation.offsets = Offsets::estimate;
  problem.start.parameters = test::appended(problem.start.parameters, 0.0);
  return problem;
}

using Climb = std::tuple<Constraint, bool>;

class BothAlgorithms : public testing::TestWithParam<Climb> {};

TEST_P(BothAlgorithms, ReachTheSameOptimum) {
  const LikelihoodProblem problem = problemOf(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const test::CoreSetup setup(problem.configuration, problem.experiments);
  const auto options = [&](double tolerance) {
    return test::optimisationOptions(problem.configuration, problem.start.mixture, tolerance);
  };
  const int before = setup.likelihood().passes();
  const Optimum fast = maximumLikelihood(setup.likelihood(), problem.start, options(1e-7));
  EXPECT_EQ(fast.termination, Termination::converged) << fast.message;
  EXPECT_LE(setup.likelihood().passes() - before, 100);
  OptimisationOptions patient = options(1e-9);
  patient.max_iterations = 20000;
  ModelParameters start = problem.start;
  if (patient.constraint ==
      Constraint::zero_mean) {  // the gain of Go against the mixture: EM crawls
    start = fast.point;
    start.noise_variance *= 1.1;
    for (MatrixXd& covariance : start.mixture.covariances) covariance *= 1.2;
  }
  const Optimum slow = expectationMaximisation(setup.likelihood(), start, patient);
  EXPECT_EQ(slow.termination, Termination::converged) << slow.message;
  EXPECT_NEAR(fast.log_likelihood, slow.log_likelihood, 1e-4);
  EXPECT_GT(fast.log_likelihood, slow.log_likelihood - 1e-5);
  if (patient.constraint == Constraint::zero_mean) {
    EXPECT_LT(fast.point.mixture.mean().norm(), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(All, BothAlgorithms,
                         testing::Values(Climb{Constraint::zero_static_gain, false},
                                         Climb{Constraint::zero_static_gain, true},
                                         Climb{Constraint::zero_mean, false},
                                         Climb{Constraint::zero_mean, true}));

TEST(MaximumLikelihood, EndsAtAMaximum) {
  const LikelihoodProblem problem = problemOf(Constraint::zero_static_gain, true);
  const test::CoreSetup setup(problem.configuration, problem.experiments);
  const OptimisationOptions options =
      test::optimisationOptions(problem.configuration, problem.start.mixture, 1e-8);
  const Optimum optimum = maximumLikelihood(setup.likelihood(), problem.start, options);
  EXPECT_NEAR(setup.logLikelihood(optimum.point), optimum.log_likelihood, 1e-9);
  int steps = 1;
  for (std::size_t k = 1; k < optimum.trace.size(); ++k) {
    const TracePoint& before = optimum.trace[k - 1];
    const TracePoint& now = optimum.trace[k];
    EXPECT_GT(now.passes, before.passes);
    if (!now.step) continue;  // the start of L-BFGS
    EXPECT_EQ(now.iteration, ++steps);
    EXPECT_EQ(now.log_likelihood > before.log_likelihood, now.step->accepted) << k;
    EXPECT_TRUE(now.step->norm > 0 || !now.step->accepted);
    EXPECT_GE(now.step->seconds, 0);
  }
  EXPECT_EQ(optimum.trace.front().iteration, 1) << "scoring steps count, too";
  EXPECT_EQ(optimum.iterations, steps);
  EXPECT_LT(optimum.trace.back().step->gradient_norm, optimum.trace[0].step->gradient_norm);
  const Parametrisation parametrisation(setup.model(), options.constraint, 2, MatrixXd::Zero(1, 1));
  const ScoredPoint top = scoredPoint(setup.likelihood(), parametrisation,
                                      parametrisation.toCoordinates(optimum.point));
  const MatrixXd information = observedInformation(setup.likelihood(), parametrisation, top, true);
  const Eigen::LLT<MatrixXd> factor(information);
  ASSERT_EQ(factor.info(), Eigen::Success) << "curved upwards somewhere";
  EXPECT_LT(0.5 * top.gradient.dot(factor.solve(top.gradient)), 1e-7);  // gain left [nats]
}

/// Also from starts from which a full step overshoots.
TEST(ScoringSteps, NeverDescend) {
  for (Constraint constraint : {Constraint::zero_static_gain, Constraint::zero_mean}) {
    for (double distance : {0.9, 0.5, 0.1}) {
      LikelihoodProblem problem = problemOf(constraint, false);
      problem.start.parameters *= distance;
      problem.start.noise_variance = 1e-3;
      const test::CoreSetup setup(problem.configuration, problem.experiments);
      OptimisationOptions options =
          test::optimisationOptions(problem.configuration, problem.start.mixture, 1e-9);
      double last = setup.logLikelihood(problem.start);
      int steps = 0;
      options.on_iterate = [&](const TracePoint& point) {
        EXPECT_GE(point.log_likelihood, last) << "distance " << distance;
        last = point.log_likelihood;
        ++steps;
        return true;
      };
      const ModelParameters near =
          scoringSteps(setup.likelihood(), problem.start, options, 12, 1e-9);
      EXPECT_NEAR(setup.logLikelihood(near), last, 1e-8 * std::abs(last));
      EXPECT_GE(steps, 3);
    }
  }
}

TEST(MaximumLikelihood, SaysHowItEnded) {
  const LikelihoodProblem problem = problemOf(Constraint::zero_static_gain, false);
  const test::CoreSetup setup(problem.configuration, problem.experiments);
  OptimisationOptions options =
      test::optimisationOptions(problem.configuration, problem.start.mixture, 1e-9);
  options.max_iterations = 2;
  const Optimum limited = maximumLikelihood(setup.likelihood(), problem.start, options);
  EXPECT_EQ(limited.termination, Termination::iteration_limit) << limited.message;
  EXPECT_TRUE(std::isfinite(limited.log_likelihood));
  EXPECT_EQ(limited.iterations, 2);
  options.max_iterations = 1;
  const Optimum one = maximumLikelihood(setup.likelihood(), problem.start, options);
  EXPECT_EQ(one.termination, Termination::iteration_limit) << one.message;
  EXPECT_EQ(one.iterations, 1);
  EXPECT_GT(limited.log_likelihood, one.log_likelihood);
  options.max_iterations = 1000;
  int calls = 0;
  options.on_iterate = [&](const TracePoint&) { return ++calls < 7; };
  const Optimum cancelled = maximumLikelihood(setup.likelihood(), problem.start, options);
  EXPECT_EQ(cancelled.termination, Termination::cancelled);
  EXPECT_GT(cancelled.log_likelihood, setup.logLikelihood(problem.start));
}

/// Returning `false` once is enough to cancel, also during the first scoring steps.
TEST(MaximumLikelihood, IsCancelledAtItsFirstIterate) {
  const LikelihoodProblem problem = problemOf(Constraint::zero_static_gain, false);
  const test::CoreSetup setup(problem.configuration, problem.experiments);
  OptimisationOptions options =
      test::optimisationOptions(problem.configuration, problem.start.mixture, 1e-9);
  int calls = 0;
  options.on_iterate = [&](const TracePoint&) { return ++calls != 1; };
  const Optimum cancelled = maximumLikelihood(setup.likelihood(), problem.start, options);
  EXPECT_EQ(cancelled.termination, Termination::cancelled);
}

/// If the likelihood cannot be evaluated, the result says so; nothing is thrown.
TEST(MaximumLikelihood, StallsWhereTheLikelihoodIsNotFinite) {
  LikelihoodProblem problem = problemOf(Constraint::zero_static_gain, false);
  for (Experiment& experiment : problem.experiments) experiment.y *= 1e200;
  const test::CoreSetup setup(problem.configuration, problem.experiments);
  const Optimum optimum = maximumLikelihood(
      setup.likelihood(), problem.start,
      test::optimisationOptions(problem.configuration, problem.start.mixture, 1e-6));
  EXPECT_EQ(optimum.termination, Termination::stalled);
  EXPECT_FALSE(optimum.message.empty());
}

/// A model whose parameters do not survive the way through unbounded coordinates, as those of
/// nearly cancelling poles at 1 may not.
class LostInRounding : public LinearModel {
 public:
  using LinearModel::LinearModel;
  VectorXd fromUnbounded(const VectorXd& unbounded) const override {
    return VectorXd::Constant(unbounded.size(), std::nan(""));
  }
};

/// The start, which can be evaluated, is not thrown away.
TEST(MaximumLikelihood, KeepsAStartThatOnlyRoundingLoses) {
  const LikelihoodProblem problem = problemOf(Constraint::zero_static_gain, false);
  const test::CoreSetup setup(problem.configuration, problem.experiments);
  const LostInRounding model(makeNominalModel(problem.configuration.nominal_model, 1),
                             setup.model().basis(), problem.configuration.estimation);
  const Likelihood likelihood(model, setup.blocks(), static_cast<int>(setup.experiments().size()),
                              1);
  const Optimum optimum = maximumLikelihood(
      likelihood, problem.start,
      test::optimisationOptions(problem.configuration, problem.start.mixture, 1e-6));
  EXPECT_EQ(optimum.termination, Termination::stalled);
  EXPECT_GE(optimum.log_likelihood, setup.logLikelihood(problem.start));
  EXPECT_NEAR(optimum.log_likelihood, setup.logLikelihood(optimum.point), 1e-6);
  EXPECT_NE(optimum.message.find("rounding"), std::string::npos) << optimum.message;
}

}  // namespace
}  // namespace uncertainty_identification
