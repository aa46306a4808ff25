// What Identifier chooses and what it reports.
#include "uncertainty_identification/identifier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "data/experiment_checks.h"
#include "support/core_setup.h"
#include "support/error_message.h"
#include "support/identify_example1.h"
#include "support/mentions.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::anyMentions;
using test::mentions;

TEST(Identifier, EvaluatesAtTheStartWithoutIterations) {
  const auto system = test::example1(4, 10);
  Configuration configuration = test::example1Configuration();
  configuration.estimation.max_iterations = 0;
  configuration.initial.theta = test::parametersOf(system.truth).parameters;
  configuration.initial.mixture = system.truth.mixture;
  configuration.initial.noise_variance = 0.1;
  const Estimate estimate = test::identified(configuration, system.experiments);
  EXPECT_NEAR(estimate.log_likelihood, dense::logLikelihood(system.experiments, system.truth),
              1e-9 * std::abs(estimate.log_likelihood));
  EXPECT_EQ(estimate.termination, Termination::not_run);
  EXPECT_TRUE(estimate.usable()) << "identify writes it";
  EXPECT_FALSE(Estimate{}.usable());
  EXPECT_EQ(estimate.iterations, 0);
  EXPECT_EQ(estimate.nominal_model.b, system.truth.b);
  EXPECT_EQ(estimate.nominal_model.d, system.truth.d);
  EXPECT_EQ(estimate.error_model.mixture.weights, system.truth.mixture.weights);
  EXPECT_EQ(estimate.noise_variance.value, 0.1);
  EXPECT_TRUE(mentions(estimate.message, "max_iterations: 0")) << estimate.message;
}

TEST(Identifier, GivesTheSameBitsWithAnyNumberOfThreads) {
  test::RandomSystemOptions options;
  options.experiments = 30;
  options.missing = 0.02;
  options.min_samples = 60;
  const auto system = test::randomSystem(options, 3);
  Configuration configuration = test::configurationOf(options);
  configuration.estimation = EstimationOptions();
  configuration.estimation.threads = 1;
  const Estimate one = test::identified(configuration, system.experiments);
  EXPECT_TRUE(one.usable()) << one.message;
  for (int threads : {2, 3}) {
    configuration.estimation.threads = threads;
    const Estimate several = test::identified(configuration, system.experiments);
    EXPECT_EQ(several.log_likelihood, one.log_likelihood);
    EXPECT_EQ(several.nominal_model.b, one.nominal_model.b);
    EXPECT_EQ(several.nominal_model.d, one.nominal_model.d);
    EXPECT_EQ(several.nominal_model.covariance, one.nominal_model.covariance);
    EXPECT_EQ(several.noise_variance.value, one.noise_variance.value);
    EXPECT_EQ(several.error_model.mixture.means, one.error_model.mixture.means);
    EXPECT_EQ(several.error_model.mixture.weights, one.error_model.mixture.weights);
    EXPECT_EQ(several.passes, one.passes);
  }
}

class Cancelled : public testing::TestWithParam<const char*> {};

TEST_P(Cancelled, InAnyPhaseEndsAndIsTold) {
  Configuration configuration = test::example1Configuration();
  configuration.nominal_model.orders_auto = GetParam() == std::string("choosing orders");
  configuration.nominal_model.max_order = 2;
  configuration.error_model.components = kAutomatic;
  std::set<std::string> phases;
  int later = 0;
  const auto progress = [&](const Progress& at) {
    later += phases.count(GetParam()) > 0 ? 1 : 0;
    phases.insert(at.phase);
    return at.phase != GetParam();
  };
  const Estimate estimate =
      Identifier(configuration)
          .identify(test::example1Experiments(20), test::example1Experiments(3, 9), progress);
  ASSERT_TRUE(phases.count(GetParam()) > 0);
  EXPECT_EQ(estimate.termination, Termination::cancelled);
  EXPECT_FALSE(estimate.usable());
  EXPECT_TRUE(estimate.validation.experiments.empty());
  EXPECT_LT(later, 30) << "cancelled, it went on";
}

INSTANTIATE_TEST_SUITE_P(Phases, Cancelled,
                         testing::Values("checking the data", "choosing orders", "starting values",
                                         "optimising", "standard errors"));

TEST(Identifier, ReportsRisingProgress) {
  double last = 0;
  Configuration configuration = test::example1Configuration();
  Identifier(configuration).identify(test::example1Experiments(20), {}, [&](const Progress& at) {
    EXPECT_GE(at.fraction, 0);
    EXPECT_LE(at.fraction, 1);
    EXPECT_FALSE(at.phase.empty());
    last = std::max(last, at.fraction);
    return true;
  });
  EXPECT_GT(last, 0.9);
}

TEST(Identifier, StartsWarmFromAnEarlierEstimate) {
  const std::vector<Experiment> all = test::example1Experiments(60);
  const std::vector<Experiment> first(all.begin(), all.begin() + 50);
  const Identifier identifier(test::example1Configuration());
  const Estimate before = identifier.identify(first);
  const Estimate cold = identifier.identify(all), warm = identifier.reidentify(before, all);
  EXPECT_EQ(warm.termination, Termination::converged) << warm.message;
  EXPECT_EQ(warm.experiment_count, 60);
  EXPECT_NEAR(warm.log_likelihood, cold.log_likelihood, 1e-4);
  EXPECT_LT(warm.passes, cold.passes / 2);
  EXPECT_LT(warm.passes, 35);
}

TEST(Identifier, StartsColdFromAnUnusableEstimate) {
  const std::vector<Experiment> experiments = test::example1Experiments(20);
  const Identifier identifier(test::example1Configuration());
  EXPECT_EQ(identifier.reidentify(Estimate(), experiments).log_likelihood,
            identifier.identify(experiments).log_likelihood);
}

TEST(Identifier, BothAlgorithmsAgree) {
  const std::vector<Experiment> experiments = test::example1Experiments(50);
  Configuration configuration = test::example1Configuration();
  const Estimate fast = test::identified(configuration, experiments);
  configuration.estimation.algorithm = Algorithm::em;
  configuration.estimation.tolerance = 1e-9;
  const Estimate slow = test::identified(configuration, experiments);
  EXPECT_NEAR(fast.log_likelihood, slow.log_likelihood, 1e-4);
  EXPECT_NEAR(fast.nominal_model.b[0], slow.nominal_model.b[0], 1e-4);
}

TEST(Identifier, FindsOrderAndDelayByItself) {
  test::RandomSystemOptions options;
  options.nb = options.na = 2;
  options.nc = options.nd = options.taps = 0;
  options.experiments = 9;
  options.min_samples = options.max_samples = 200;
  options.noise_variance = 0.3;
  options.input_run_up = 100;
  auto system = test::randomSystem(options, 2);
  system.truth.delay = 3;
  system.truth.b = test::vectorOf({0.5, 0.4});
  system.truth.a = test::vectorOf({-1.4, 0.65});
  system = test::simulateSystem(system.truth, options, 3);
  Configuration configuration;
  configuration.nominal_model.orders_auto = true;
  configuration.nominal_model.max_order = 4;
  configuration.nominal_model.max_delay = 8;
  const Estimate estimate = test::identified(configuration, system.experiments);
  EXPECT_TRUE(estimate.usable()) << estimate.message;
  EXPECT_EQ(estimate.nominal_model.delay, 3);
  EXPECT_EQ(estimate.nominal_model.a.size(), 2);
  EXPECT_LT((estimate.nominal_model.a - system.truth.a).norm(), 0.05);
  EXPECT_FALSE(estimate.configuration.nominal_model.orders_auto);
  EXPECT_EQ(estimate.configuration.nominal_model.delay, 3);
  EXPECT_TRUE(std::any_of(estimate.candidates.begin(), estimate.candidates.end(),
                          [](const Candidate& c) { return c.choice == "orders" && c.chosen; }));
}

/// Go of least simulation error, the noise and the mixture around it.
TEST(Identifier, FitsGoToItsSimulation) {
  const std::vector<Experiment> experiments = test::example1Experiments(40);
  Configuration configuration = test::example1Configuration();
  configuration.nominal_model.fit = PlantFit::simulation;
  const Estimate held = test::identified(configuration, experiments);
  EXPECT_TRUE(held.usable()) << held.message;
  Configuration plain = test::example1Configuration();
  plain.nominal_model.structure = Structure::output_error;
  plain.error_model.taps = 0;
  plain.error_model.components = 1;
  const Estimate simulation = test::identified(plain, experiments);
  EXPECT_LT((held.nominal_model.b - simulation.nominal_model.b).norm(), 1e-5);
  EXPECT_LT((held.nominal_model.a - simulation.nominal_model.a).norm(), 1e-5);
  ASSERT_EQ(held.nominal_model.parameters.size(), 4u);
  EXPECT_EQ(held.nominal_model.parameters[0].name, "b1");
  EXPECT_EQ(held.nominal_model.parameters[3].name, "d1");
  for (const ParameterEstimate& parameter : held.nominal_model.parameters) {
    EXPECT_GT(parameter.standard_error, 0) << parameter.name;
  }
  EXPECT_EQ(held.error_model.mixture.components(), 2);
  EXPECT_LT(held.log_likelihood,
            test::identified(test::example1Configuration(), experiments).log_likelihood);
}

/// What bounds rest on: the plant's part is the nominal model's covariance in other coordinates.
TEST(Identifier, GivesTheJointCovarianceOfPlantAndMixture) {
  const Estimate estimate =
      test::identified(test::example1Configuration(), test::example1Experiments(40));
  const Eigen::MatrixXd& joint = estimate.joint_covariance;
  ASSERT_EQ(joint.rows(), 2 + 1 + 2 + 2);  // b1, a1; a weight, two means, two variances
  const Eigen::MatrixXd& covariance = estimate.nominal_model.covariance;
  const double slope = 1 - std::pow(estimate.nominal_model.a[0], 2);  // da/dz
  EXPECT_NEAR(joint(0, 0), covariance(0, 0), 1e-9 * covariance(0, 0));
  EXPECT_NEAR(joint(1, 1) * slope * slope, covariance(1, 1), 1e-9 * covariance(1, 1));
  for (int k = 0; k < 2; ++k) {
    const double error =
        estimate.error_model.parameters[2 + static_cast<std::size_t>(k)].standard_error;
    EXPECT_NEAR(std::sqrt(joint(3 + k, 3 + k)), error, 1e-9 * error);
  }
  Configuration simulation = test::example1Configuration();
  simulation.nominal_model.fit = PlantFit::simulation;
  const Estimate held = test::identified(simulation, test::example1Experiments(40));
  EXPECT_GT(held.joint_covariance(0, 0), 0);
  EXPECT_EQ(held.joint_covariance.rows(), joint.rows());
}

TEST(Identifier, LeavesAStartWithoutDeadTime) {
  test::RandomSystemOptions options;
  options.nc = options.nd = options.taps = 0;
  auto system = test::randomSystem(options, 2);
  system.truth.b = test::vectorOf({0.3});
  system.truth.a = test::vectorOf({-0.7});
  system = test::simulateSystem(system.truth, options, 3);
  Configuration configuration = test::configurationOf(options);
  NominalModelOptions& nominal = configuration.nominal_model;
  nominal.structure = Structure::continuous;
  nominal.dead_time = true;
  nominal.max_delay = 3;
  configuration.initial.theta = test::vectorOf({1.0, 2.0, 0.0});
  const Estimate estimate = test::identified(configuration, system.experiments);
  EXPECT_TRUE(std::isfinite(estimate.log_likelihood)) << estimate.message;
  EXPECT_NEAR(estimate.nominal_model.parameters[0].value, 1, 0.05);
  EXPECT_NEAR(estimate.nominal_model.parameters[1].value, -1 / std::log(0.7), 0.1);
}

TEST(Identifier, FindsTheNumberOfComponentsInClearCases) {
  Configuration configuration = test::example1Configuration();
  configuration.error_model.components = kAutomatic;
  const Estimate two = test::identified(configuration, test::example1Experiments(80));
  EXPECT_EQ(two.error_model.mixture.components(), 2);
  EXPECT_EQ(two.configuration.error_model.components, 2);
  auto system = test::example1(1, 5);
  system.truth.mixture = {{1.0}, {VectorXd::Constant(1, 0.5)}, {MatrixXd::Constant(1, 1, 0.2)}};
  test::RandomSystemOptions options;
  options.experiments = 80;
  system = test::simulateSystem(system.truth, options, 2);
  const Estimate one = test::identified(configuration, system.experiments);
  EXPECT_EQ(one.error_model.mixture.components(), 1);
  int tried = 0;
  for (const Candidate& candidate : one.candidates) tried += candidate.choice == "components";
  EXPECT_EQ(tried, configuration.error_model.max_components);
}

TEST(Identifier, FindsTheNumberOfTaps) {
  Configuration configuration = test::example1Configuration();
  configuration.error_model.taps = kAutomatic;
  configuration.error_model.components = 1;
  const Estimate estimate = test::identified(configuration, test::example1Experiments(60));
  EXPECT_EQ(estimate.error_model.options.taps, 2);
  EXPECT_EQ(estimate.error_model.T.rows(), 2);
}

class OutputOffset : public testing::TestWithParam<OffsetSide> {};

TEST_P(OutputOffset, IsRecovered) {
  std::vector<Experiment> shifted = test::example1Experiments(40);
  const double gain = 1 / 1.5, offset = 2.5;
  const bool at_input = GetParam() == OffsetSide::input;
  for (Experiment& experiment : shifted) {
    experiment.y.array() += at_input ? offset * gain : offset;
  }
  Configuration configuration = test::example1Configuration();
  configuration.estimation.initial_state = InitialState::estimate;
  configuration.estimation.offsets = Offsets::estimate;
  configuration.estimation.offset_side = GetParam();
  const Estimate estimate = test::identified(configuration, shifted);
  EXPECT_TRUE(estimate.usable()) << estimate.message;
  EXPECT_NEAR(at_input ? estimate.offset_u : estimate.offset_y, offset, 0.02);
  EXPECT_EQ(at_input ? estimate.offset_y : estimate.offset_u, 0);
  EXPECT_NEAR(estimate.nominal_model.b[0], 1, 0.01);
  EXPECT_EQ(estimate.nominal_model.parameters.size(), 4u) << "the offset is no part of theta";
}

INSTANTIATE_TEST_SUITE_P(Sides, OutputOffset,
                         testing::Values(OffsetSide::output, OffsetSide::input));

TEST(Identifier, MeasuresValidationExperiments) {
  const auto fresh = test::example1(8, 6);
  const Configuration configuration = test::example1Configuration();
  const Estimate estimate =
      Identifier(configuration).identify(test::example1Experiments(30), fresh.experiments);
  const Validation& validation = estimate.validation;
  ASSERT_EQ(validation.simulation_fit_percent.size(), 6u);
  dense::Model found = fresh.truth;
  found.b = estimate.nominal_model.b;
  found.a = estimate.nominal_model.a;
  found.c = estimate.nominal_model.c;
  found.d = estimate.nominal_model.d;
  found.mixture = estimate.error_model.mixture;
  found.noise_variance = estimate.noise_variance.value;
  // The mean plant, Go (1 + eta_0 - eta_0 q^-1) at the mean of eta_0.
  const double eta = found.mixture.mean()[0];
  const VectorXd mean_b = found.b[0] * Eigen::Vector2d(1 + eta, -eta);
  for (std::size_t r = 0; r < 6; ++r) {
    const Experiment& experiment = fresh.experiments[r];
    EXPECT_EQ(validation.experiments[r], experiment.id);
    const dense::Matrix plant =
        dense::toeplitz(dense::impulseResponse(mean_b, dense::monic(found.a), found.delay, 100));
    const VectorXd simulated = (plant * experiment.u.cast<dense::Real>()).cast<double>();
    const VectorXd away = experiment.y.array() - experiment.y.mean();
    EXPECT_NEAR(validation.simulation_fit_percent[r],
                100 * (1 - (experiment.y - simulated).norm() / away.norm()), 1e-9);
  }
  EXPECT_NEAR(validation.log_density_per_experiment,
              dense::logLikelihood(fresh.experiments, found) / 6, 1e-7);
  EXPECT_EQ(estimate.experiment_count, 30) << "validation experiments only measure";
  EXPECT_THROW(Identifier(configuration).identify(fresh.experiments, {Experiment()}), DataError);
}

TEST(Identifier, DescribesWhatItFound) {
  const auto system = test::example1(2, 40);
  const Configuration configuration = test::example1Configuration();
  const Estimate estimate = test::identified(configuration, system.experiments);
  EXPECT_EQ(estimate.nominal_model.structure, "box_jenkins");
  EXPECT_EQ(estimate.nominal_model.sample_time, 1.0);
  EXPECT_EQ(estimate.nominal_model.delay, 1);
  EXPECT_EQ(estimate.error_model.T, Eigen::Vector2d(1, -1));
  EXPECT_FALSE(estimate.version.empty());
  EXPECT_GT(estimate.passes, 0);
  EXPECT_GT(estimate.seconds, 0);
  ASSERT_EQ(estimate.experiments.size(), 40u);
  ASSERT_GE(estimate.trace.size(), 1u);
  EXPECT_EQ(estimate.trace.back().log_likelihood, estimate.log_likelihood);
  double total = 0;
  int right = 0;
  for (std::size_t r = 0; r < 40; ++r) {
    const ExperimentEstimate& one = estimate.experiments[r];
    EXPECT_EQ(one.id, system.experiments[r].id);
    EXPECT_EQ(one.samples, 100);
    EXPECT_NEAR(one.responsibilities[0] + one.responsibilities[1], 1, 1e-12);
    EXPECT_NEAR(one.error_mean[0], system.errors[r][0], 0.1);
    right += one.responsibilities[static_cast<std::size_t>(system.components[r])] > 0.5;
    total += one.log_likelihood;
  }
  EXPECT_NEAR(total, estimate.log_likelihood, 1e-8);
  EXPECT_GE(right, 36);
  // 4 of theta and sigma^2 see all samples, 5 of the mixture the experiments
  EXPECT_NEAR(estimate.bic,
              -2 * estimate.log_likelihood + 5 * std::log(4000.0) + 5 * std::log(40.0), 1e-8);
}

TEST(Identifier, ReportsAComponentAtItsFloor) {
  auto system = test::example1(2, 20);
  system.truth.noise_variance = 1e-4;
  system.truth.mixture = {{1.0}, {VectorXd::Zero(1)}, {MatrixXd::Constant(1, 1, 0.2)}};
  test::RandomSystemOptions options;
  options.experiments = 30;
  system = test::simulateSystem(system.truth, options, 5);
  dense::Model far = system.truth;
  far.mixture = {{1.0}, {VectorXd::Constant(1, 8)}, {MatrixXd::Constant(1, 1, 1e-12)}};
  options.experiments = 2;
  for (Experiment& twin : test::simulateSystem(far, options, 6).experiments) {
    twin.id += "twin";
    system.experiments.push_back(twin);
  }
  const Estimate estimate = test::identified(test::example1Configuration(), system.experiments);
  ASSERT_EQ(estimate.error_model.mixture.components(), 2);
  EXPECT_NEAR(estimate.error_model.mixture.means[1][0], 8, 0.2);
  EXPECT_GT(estimate.error_model.mixture.covariances[1](0, 0), 1e-6);
  EXPECT_TRUE(anyMentions(estimate.warnings, "component 2 is at its lower limit"));
}

TEST(Identifier, ReportsWhatTheDataCannotTellApart) {
  test::RandomSystemOptions options;
  options.taps = 1;
  options.zero_static_gain = false;
  options.components = 1;
  options.experiments = 30;
  const auto system = test::randomSystem(options, 7);
  const Estimate estimate = test::identified(test::configurationOf(options), system.experiments);
  EXPECT_TRUE(anyMentions(estimate.warnings, "cannot be told apart"));
  EXPECT_TRUE(anyMentions(estimate.warnings, "b1"));
  EXPECT_TRUE(std::isnan(estimate.nominal_model.parameters[0].standard_error));
  EXPECT_GT(estimate.nominal_model.parameters[1].standard_error, 0);
}

TEST(Identifier, SaysThatItDidNotConverge) {
  Configuration configuration = test::example1Configuration();
  configuration.estimation.algorithm = Algorithm::em;
  configuration.estimation.max_iterations = 2;
  configuration.estimation.tolerance = 1e-12;
  const Estimate estimate = test::identified(configuration, test::example1Experiments(20));
  EXPECT_EQ(estimate.termination, Termination::iteration_limit);
  EXPECT_TRUE(estimate.usable());
  EXPECT_TRUE(anyMentions(estimate.trust.reasons, "did not converge"));
}

}  // namespace
}  // namespace uncertainty_identification
