// Dead times that are not a whole number of samples are found from the data alone.
#include <gtest/gtest.h>

#include <random>

#include "estimation/least_squares_models.h"
#include "model/continuous.h"
#include "support/core_setup.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using test::vectorOf;

constexpr double kSampleTime = 0.02;

/// A plant with a dead time, without an own configuration of its longest.
struct LatePlant {
  Configuration configuration;
  VectorXd theta;
  std::vector<Experiment> experiments;
};

/// Behind white noise, or noise of a first-order C/D whose two coefficients `theta` ends with.
LatePlant latePlant(int time_constants, const VectorXd& theta, int samples,
                    bool coloured_noise = false, std::uint64_t seed = 2) {
  NominalModelOptions structure;
  structure.structure = Structure::continuous;
  structure.orders_auto = false;
  structure.time_constants = time_constants;
  structure.dead_time = true;
  structure.nc = structure.nd = coloured_noise ? 1 : 0;
  const Polynomials p = makeContinuous(structure, kSampleTime)->polynomials(theta);
  test::RandomSystemOptions options;
  options.nb = static_cast<int>(p.b.size());
  options.na = time_constants;
  options.nc = options.nd = structure.nc;
  options.components = 1;
  options.experiments = 20;
  options.min_samples = options.max_samples = samples;
  options.input_run_up = 60;
  options.input_deviation = 1;
  options.noise_variance = coloured_noise ? 0.1 : 0.01;
  dense::Model truth = test::randomSystem(options, 1).truth;
  truth.b = p.b;
  truth.a = p.a;
  truth.c = p.c;
  truth.d = p.d;
  LatePlant plant{test::configurationOf(options), theta,
                  test::simulateSystem(truth, options, seed).experiments};
  for (Experiment& experiment : plant.experiments) experiment.sample_time = kSampleTime;
  plant.configuration.nominal_model = structure;
  plant.configuration.estimation.initial_state = InitialState::estimate;
  plant.configuration.estimation.initial_precision = 1e-6;
  plant.configuration.bounds.frequencies = 0;
  return plant;
}

void expectAsHighAsFromTheTruth(const LatePlant& plant, std::uint64_t seed) {
  const Estimate found = Identifier(plant.configuration).identify(plant.experiments);
  Configuration given = plant.configuration;
  given.initial.theta = plant.theta;
  const Estimate from_truth = Identifier(given).identify(plant.experiments);
  EXPECT_GT(found.log_likelihood, from_truth.log_likelihood - 0.1) << "seed " << seed;
}

class DeadTime : public testing::TestWithParam<double> {};

TEST_P(DeadTime, IsFoundWithinItsStandardError) {
  const double dead_time = GetParam() * kSampleTime;
  const LatePlant plant = latePlant(1, vectorOf({1.5, 0.08, dead_time}), 100);
  const Estimate found = Identifier(plant.configuration).identify(plant.experiments);
  Configuration given = plant.configuration;
  given.initial.theta = plant.theta;
  const Estimate from_truth = Identifier(given).identify(plant.experiments);
  EXPECT_GT(found.log_likelihood, from_truth.log_likelihood - 0.1);
  const ParameterEstimate& estimate = found.nominal_model.parameters.back();
  ASSERT_EQ(estimate.name, "dead_time");
  // one of six estimates is further off with a probability of 4e-4
  EXPECT_NEAR(estimate.value, dead_time, 4 * estimate.standard_error);
  EXPECT_LT(estimate.standard_error, 0.1 * kSampleTime);
}

INSTANTIATE_TEST_SUITE_P(Samples, DeadTime, testing::Values(0.3, 0.95, 1.5, 2.7, 4.05, 6.4));

/// B is as long as the dead time needs: with the 23 unknown initial values of the longest dead time
/// that is allowed, so short experiments would be refused.
TEST(ShortExperiments, DetermineADeadTime) {
  const LatePlant plant = latePlant(1, vectorOf({1.5, 0.08, 2.4 * kSampleTime}), 40);
  ASSERT_EQ(plant.configuration.nominal_model.max_delay, 20);
  const Estimate found = Identifier(plant.configuration).identify(plant.experiments);
  EXPECT_NEAR(found.nominal_model.parameters.back().value, 2.4 * kSampleTime, 0.3 * kSampleTime);
  EXPECT_LT(found.configuration.nominal_model.max_delay, 8);
  EXPECT_LT(found.nominal_model.b.size(), 10);
}

TEST(TimeConstants, AreReportedInAscendingOrder) {
  const LatePlant plant = latePlant(2, vectorOf({1.5, 0.2, 0.05, 1.5 * kSampleTime}), 200);
  Configuration given = plant.configuration;
  given.initial.theta = plant.theta;
  for (const Configuration& configuration : {plant.configuration, given}) {
    const Estimate found = Identifier(configuration).identify(plant.experiments);
    const auto& parameters = found.nominal_model.parameters;
    EXPECT_NEAR(parameters[1].value, 0.05, 4 * parameters[1].standard_error);
    EXPECT_NEAR(parameters[2].value, 0.2, 4 * parameters[2].standard_error);
    EXPECT_LT(parameters[2].standard_error, 0.03);
  }
}

/// Regressions of low order on the measured outputs find a gain of 0.2 and poles of twice the time.
TEST(DeadTimes, AreFoundBesideNoiseOfHighFrequency) {
  const VectorXd theta = vectorOf({1.2, 0.034, 0.08, 0.54 * kSampleTime, -0.85, 0.74});
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    expectAsHighAsFromTheTruth(latePlant(2, theta, 250, true, seed), seed);
}

/// GDelta = xi (1 - q^-1) delays by -xi samples; with another dead time it may do so again.
TEST(DeadTimes, AreFoundBesideAnErrorThatDelays) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    LatePlant plant = latePlant(1, vectorOf({1, 0.09, 8.64 * kSampleTime}), 200);
    const Polynomials go =
        makeContinuous(plant.configuration.nominal_model, kSampleTime)->polynomials(plant.theta);
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    for (Experiment& experiment : plant.experiments) {
      for (int k = 0; k < experiment.samples(); ++k) experiment.u[k] = normal(engine) > 0 ? 1 : -1;
      experiment.y = simulated(go, 0, experiment.u);
      const double xi = -1.1 + 0.1 * normal(engine);
      VectorXd before = VectorXd::Zero(experiment.y.size());
      before.tail(before.size() - 1) = experiment.y.head(before.size() - 1);
      experiment.y += xi * (experiment.y - before);
      for (int k = 0; k < experiment.samples(); ++k) experiment.y[k] += 0.01 * normal(engine);
    }
    plant.configuration.estimation.initial_state = InitialState::zero;
    expectAsHighAsFromTheTruth(plant, seed);
  }
}

}  // namespace
}  // namespace uncertainty_identification
