// Parameters that vary from experiment to experiment, on the paper's Example 2, where the truth is
// a time constant uniform within 40 % of 10 ms.
#include "estimation/linearisation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "io/truth_yaml.h"
#include "model/sensitivity_model.h"
#include "simulation/simulate.h"
#include "support/core_setup.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"
#include "uncertainty_identification/io/configuration_yaml.h"

namespace uncertainty_identification {
namespace {

constexpr std::uint64_t kSeed = 7;

Truth truth() {
  Truth made = loadTruth(std::string(PROJECT_FOLDER) + "/config/example2_truth.yaml");
  made.experiments = 60;
  return made;
}

Configuration configuration(const std::string& name) {
  Configuration made = loadConfiguration(std::string(PROJECT_FOLDER) + "/config/" + name + ".yaml");
  made.estimation.threads = 1;
  return made;
}

Estimate identified(const Configuration& configuration) {
  return Identifier(configuration).identify(simulate(truth(), kSeed));
}

TEST(Linearisation, FindsEveryExperimentsOwnTimeConstant) {
  const Estimate estimate = identified(configuration("example2_parameter_spread"));
  ASSERT_EQ(estimate.termination, Termination::converged) << estimate.message;
  const ParameterEstimate& tau = estimate.nominal_model.parameters.front();
  const ParameterEstimate& noise = estimate.noise_variance;
  double sum = 0, drawn = 0, squares = 0;
  for (int r = 0; r < truth().experiments; ++r) {
    const double own =
        tau.value * (1 + estimate.experiments[static_cast<std::size_t>(r)].error_mean[0]);
    const double of_truth = drawSystem(truth(), kSeed, r).time_constant.value();
    // A time constant is known to about 1 %: 100 samples at this signal-to-noise ratio. The
    // largest of 60 errors stays within 4 standard errors.
    EXPECT_NEAR(own, of_truth, 0.05 * of_truth) << r;
    sum += own;
    drawn += of_truth;
    squares += std::pow(own / of_truth - 1, 2);
  }
  EXPECT_LT(std::sqrt(squares / truth().experiments), 0.015);
  EXPECT_NEAR(sum, drawn, 0.01 * drawn);
  // With zero_mean the nominal value is the mean over the experiments.
  EXPECT_NEAR(tau.value, sum / truth().experiments, 2e-3 * tau.value);
  EXPECT_NEAR(tau.value, 0.01, 4 * tau.standard_error);
  EXPECT_NEAR(tau.standard_error, 0.01 * 0.4 / std::sqrt(3.0 * 60), 0.0001);
  EXPECT_NEAR(noise.value, 0.1, 3 * noise.standard_error);
}

TEST(Linearisation, EndsWhereThePointsAreThePosteriorMeans) {
  const Configuration asked = configuration("example2_parameter_spread");
  const Estimate estimate = identified(asked);
  Configuration at_estimate = asked;
  at_estimate.estimation.max_iterations = 0;
  at_estimate.initial.theta =
      Eigen::VectorXd::Constant(1, estimate.nominal_model.parameters.front().value);
  at_estimate.initial.mixture = estimate.error_model.mixture;
  at_estimate.initial.noise_variance = estimate.noise_variance.value;
  const Estimate evaluated = identified(at_estimate);
  // The fixed-point iteration from zero ends at the same points as the optimisation.
  EXPECT_NEAR(evaluated.log_likelihood, estimate.log_likelihood, 1e-3);
  for (std::size_t r = 0; r < estimate.experiments.size(); ++r) {
    EXPECT_NEAR(evaluated.experiments[r].error_mean[0], estimate.experiments[r].error_mean[0],
                kFixedPointTolerance * 0.3);
  }
}

/// A linear model about points far from the posterior means promises more than the plants hold.
TEST(Linearisation, ALikelihoodCountsOnlyAtItsPoints) {
  Configuration asked = configuration("example2_parameter_spread");
  asked.error_model.components = 1;
  const Estimate estimate = identified(asked);
  const std::vector<Experiment> experiments = simulate(truth(), kSeed);
  const test::CoreSetup setup(asked, experiments);
  const ModelParameters point{
      Eigen::VectorXd::Constant(1, estimate.nominal_model.parameters.front().value),
      estimate.error_model.mixture, estimate.noise_variance.value};
  const int count = truth().experiments;
  int passes = 0;
  const auto settled =
      linearisedAtPosteriorMeans(setup.model(), setup.blocks(), count, 1, point, &passes);
  const Likelihood there(*settled->model, setup.blocks(), count, 1);
  const double held = logLikelihoodAtPoints(*settled->model, there, point, settled->points);
  EXPECT_NEAR(held, estimate.log_likelihood, 1e-3) << "nothing is promised at the fixed point";

  const Eigen::MatrixXd zero = setup.model().firstPoints(setup.blocks(), point.parameters, count);
  const auto about_zero = setup.model().linearisedAbout(zero);
  const Likelihood far(*about_zero, setup.blocks(), count, 1);
  const double of_linear = far.expect(far.statistics(point.parameters, false), point).total();
  const double of_plants = logLikelihoodAtPoints(*about_zero, far, point, zero);
  // By Laplace's method about xi = 0: the density there times the width of the posterior.
  double expected = 0;
  const LatentMoments moments =
      latentMoments(far.expect(far.statistics(point.parameters, false), point));
  ModelParameters at_zero = point;
  at_zero.mixture.covariances[0] *= 1e-12;
  const double density = far.expect(far.statistics(point.parameters, false), at_zero).total();
  for (int r = 0; r < count; ++r)
    expected += std::log(moments.covariances(0, r) / point.mixture.covariances[0](0, 0)) / 2;
  EXPECT_NEAR(of_plants, density + expected, 1e-3);
  EXPECT_LT(of_plants, of_linear - 100);
}

TEST(Linearisation, BothAlgorithmsAgree) {
  Configuration em = configuration("example2_parameter_spread");
  const Estimate by_quasi_newton = identified(em);
  em.estimation.algorithm = Algorithm::em;
  const Estimate by_em = identified(em);
  EXPECT_NEAR(by_em.log_likelihood, by_quasi_newton.log_likelihood, 0.01);
  EXPECT_NEAR(by_em.nominal_model.parameters.front().value,
              by_quasi_newton.nominal_model.parameters.front().value,
              0.05 * by_quasi_newton.nominal_model.parameters.front().standard_error);
}

TEST(Linearisation, SensitivitiesExpressTheSpreadBetterThanOneTap) {
  const double taps = identified(configuration("example2")).log_likelihood;
  Configuration sensitivity = configuration("example2_sensitivity");
  const Estimate second = identified(sensitivity);
  sensitivity.error_model.sensitivity_order = 1;
  const Estimate first = identified(sensitivity);
  EXPECT_GT(first.log_likelihood, taps + 100);
  EXPECT_GT(second.log_likelihood, first.log_likelihood + 50);
  EXPECT_EQ(second.error_model.options.taps, 2);
  EXPECT_EQ(second.error_model.options.parameters, (std::vector<std::string>{"tau1"}));
  // one term of each order is left out: the misfit that goes into the noise variance shrinks
  EXPECT_NEAR(second.noise_variance.value, 0.1, 3 * second.noise_variance.standard_error);
}

TEST(Linearisation, ValidationExperimentsGetPointsOfTheirOwn) {
  const std::vector<Experiment> experiments = simulate(truth(), kSeed);
  const Estimate estimate =
      Identifier(configuration("example2_parameter_spread")).identify(experiments, experiments);
  EXPECT_NEAR(estimate.validation.log_density_per_experiment * truth().experiments,
              estimate.log_likelihood, 1e-3);
}

TEST(Linearisation, OneExperimentAndHeldPlantsHaveNoSpread) {
  Truth one = truth();
  one.experiments = 1;
  const Estimate alone =
      Identifier(configuration("example2_parameter_spread")).identify(simulate(one, kSeed));
  EXPECT_EQ(alone.error_model.mixture.dimension(), 0);
  EXPECT_FALSE(alone.warnings.empty());

  Configuration held = configuration("example2_sensitivity");
  held.nominal_model = NominalModelOptions();
  held.nominal_model.structure = Structure::output_error;
  held.nominal_model.fit = PlantFit::simulation;
  EXPECT_THROW(identified(held), ConfigurationError);
}

// x -> slope x has its fixed point at 0, which undamped steps leave for a slope below -1 and circle
// about in two dimensions.
TEST(StepShare, LetsStepsThatMoveToAndFroConverge) {
  for (const double slope : {-0.95, -1.5, -3.0}) {
    StepShare share;
    double x = 1;
    for (int round = 0; round < 40; ++round) {
      const double step = slope * x - x;
      x += share.of(Eigen::MatrixXd::Constant(1, 1, step)) * step;
    }
    EXPECT_LT(std::abs(x), 1e-6) << slope;
  }
  StepShare share;
  Eigen::Vector2d x(1, 0);
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(1.3).toRotationMatrix();
  for (int round = 0; round < 60; ++round) {
    const Eigen::Vector2d step = turn * x - x;
    x += share.of(step) * step;
  }
  EXPECT_LT(x.norm(), 1e-4);
}

TEST(StepShare, TakesStepsThatLeadOnAsTheyAre) {
  StepShare share;
  for (const double step : {1.0, 0.9, 0.85, 0.8, -0.1, 0.01})
    EXPECT_EQ(share.of(Eigen::MatrixXd::Constant(1, 1, step)), 1) << step;
}

TEST(FixedPointProgress, GoesOnWhilePointsMoveLessAndLess) {
  FixedPointProgress progress;
  EXPECT_TRUE(progress.approaches(-100, 0.2));
  double move = 0.5;
  for (int round = 0; round < 2 * FixedPointProgress::kPatience; ++round, move *= 0.95) {
    EXPECT_TRUE(progress.approaches(-101 - round, move)) << round;
    EXPECT_EQ(progress.slowsDown(), round > 0);
  }
}

TEST(FixedPointProgress, EndsAfterRoundsThatLeadAway) {
  FixedPointProgress progress;
  EXPECT_TRUE(progress.approaches(-100, 3.0));
  EXPECT_TRUE(progress.approaches(-110, 2.0)) << "the points move less";
  for (int round = 1; round < FixedPointProgress::kPatience; ++round)
    EXPECT_TRUE(progress.approaches(-110 - round, 2.5)) << round;
  EXPECT_TRUE(progress.approaches(-99, 2.5)) << "the likelihood is higher than ever";
  for (int round = 1; round < FixedPointProgress::kPatience; ++round)
    EXPECT_TRUE(progress.approaches(-110 - round, 2.5)) << round;
  EXPECT_FALSE(progress.approaches(-120, 2.5));
}

}  // namespace
}  // namespace uncertainty_identification
