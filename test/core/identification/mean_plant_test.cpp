// Which of two simulations is worse, and the plant in the middle of a distribution.
#include "identification/mean_plant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "identification/identify.h"
#include "identification/steps.h"
#include "math/polynomial.h"
#include "support/core_setup.h"
#include "support/identify_example1.h"

namespace uncertainty_identification {
namespace {

using test::vectorOf;

SimulationFit fits(std::vector<double> percent, double pooled) {
  SimulationFit fit;
  fit.percent = std::move(percent);
  fit.pooled = pooled;
  return fit;
}

TEST(SimulatesWorse, WhereAllExperimentsSayIt) {
  EXPECT_TRUE(simulatesWorse(fits({80, 79, 81, 80}, 80), fits({85, 84.5, 86, 85}, 85)));
  EXPECT_FALSE(simulatesWorse(fits({85, 84.5, 86, 85}, 85), fits({80, 79, 81, 80}, 80)));
}

TEST(SimulatesWorse, NotWhereTheExperimentsDisagree) {
  EXPECT_FALSE(simulatesWorse(fits({70, 79, 91, 80}, 80), fits({90, 84.5, 80, 85}, 85)));
}

TEST(SimulatesWorse, NotByHalfAPercent) {
  EXPECT_FALSE(simulatesWorse(fits({80, 79, 81, 80}, 80), fits({80.4, 79.4, 81.4, 80.4}, 80.4)));
}

TEST(SimulatesWorse, AtOnceWhereThreeExperimentsCannotDisagree) {
  EXPECT_TRUE(simulatesWorse(fits({70, 79, 91}, 80), fits({90, 84.5, 80}, 85)));
  EXPECT_TRUE(simulatesWorse(fits({80, std::nan(""), 91, 80}, 80), fits({90, 84, 80, 81}, 85)));
}

TEST(MeanPlant, HasTheMeanOfTheErrorModelInItsNumerator) {
  Configuration configuration = test::example1Configuration();
  Journal journal{ProgressPhases({})};
  const CheckedData data = checkData(configuration, test::example1Experiments(5), &journal);
  Problem problem{data, {}, nullptr, configuration, {}, {}};
  problem.configuration = chooseInitialState(configuration, data, &journal);
  StructureFit fit =
      *fitStructure(problem, {"fir, 2 taps", problem.configuration}, {}, true, &journal);
  fit.point.mixture = {{1.0}, {vectorOf({0.5})}, {Eigen::MatrixXd::Identity(1, 1)}};
  const Eigen::VectorXd eta = 0.5 * fit.model->basis().T().col(0), b = fit.start().polynomials.b;
  ASSERT_EQ(eta.size(), 2);
  ASSERT_EQ(b.size(), 1);
  const Polynomials mean = meanPlant(fit);
  ASSERT_EQ(mean.b.size(), 2);
  EXPECT_DOUBLE_EQ(mean.b[0], b[0] * (1 + eta[0]));
  EXPECT_DOUBLE_EQ(mean.b[1], b[0] * eta[1]);
  EXPECT_EQ(mean.a, fit.start().polynomials.a);
}

/// Dead times that vary by 20 %, of 1.5 samples, exist; by 80 %, some are negative.
TEST(PlantsExist, WhereADeadTimeStaysPositive) {
  Configuration configuration = test::example1Configuration();
  NominalModelOptions& nominal = configuration.nominal_model;
  nominal.structure = Structure::continuous;
  nominal.time_constants = 1;
  nominal.zeros = nominal.resonances = nominal.nc = nominal.nd = 0;
  nominal.dead_time = true;
  nominal.delay = 1;
  nominal.max_delay = 3;
  ErrorModelOptions& errors = configuration.error_model;
  errors.basis = BasisKind::parameter_spread;
  errors.constraint = Constraint::zero_mean;
  errors.parameters = {"gain", "dead_time"};
  errors.taps = 2;
  Journal journal{ProgressPhases({})};
  const CheckedData data = checkData(configuration, test::example1Experiments(3), &journal);
  const Problem problem{data, {}, nullptr, configuration, {}, {}};
  const double sample_time = data.sampleTime();
  StructureFit fit{{"", configuration, {}}, buildModel(problem), {}, 0, 0, 0};
  fit.point.parameters = vectorOf({2, 5 * sample_time, 1.5 * sample_time});
  const auto existWith = [&](double deviation) {
    const Eigen::Vector2d variances(0.01, deviation * deviation);
    fit.point.mixture = {{1.0}, {Eigen::VectorXd::Zero(2)}, {variances.asDiagonal()}};
    return plantsExist(fit);
  };
  EXPECT_TRUE(existWith(0.2));
  EXPECT_FALSE(existWith(0.8));
}

/// 600 samples of a plant of second order, driven by white noise.
Experiment recordOf(double a1, double a2, double b, const std::function<double(int)>& disturbance) {
  Experiment record;
  record.id = "record";
  record.sample_time = 1;
  record.u = record.y = Eigen::VectorXd::Zero(600);
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int k = 0; k < record.u.size(); ++k) record.u[k] = normal(random);
  for (int k = 2; k < record.u.size(); ++k)
    record.y[k] = -a1 * record.y[k - 1] - a2 * record.y[k - 2] + b * record.u[k - 1];
  for (int k = 0; k < record.u.size(); ++k) record.y[k] += disturbance(k) + 0.05 * normal(random);
  return record;
}

/// A disturbance that oscillates throughout one record looks like the free response of a mode that
/// never decays, and would be simulated as such.
TEST(OrdersOfAPlant, DoNotIncludeADisturbanceThatOscillates) {
  const auto hum = [](int k) { return 1.5 * std::sin(0.5 * k + 1); };
  const Estimate estimate = identify({}, {recordOf(-0.9, 0, 0.5, hum)}, {});
  for (const std::complex<double>& root : roots(estimate.nominal_model.a))
    EXPECT_TRUE(root.imag() == 0 || std::abs(root) < 0.995) << root;
  EXPECT_NEAR(estimate.nominal_model.b.sum() / (1 + estimate.nominal_model.a.sum()), 5, 0.5);
}

/// Without its oscillation the plant would simulate held-out data far worse.
TEST(OrdersOfAPlant, IncludeAnOscillationThatTheInputExcites) {
  const double radius = 0.998, angle = 0.3;
  const double a1 = -2 * radius * std::cos(angle), a2 = radius * radius;
  const Estimate estimate = identify({}, {recordOf(a1, a2, 0.1, [](int) { return 0.0; })}, {});
  ASSERT_EQ(estimate.nominal_model.a.size(), 2);
  EXPECT_NEAR(estimate.nominal_model.a[0], a1, 1e-3);
  EXPECT_NEAR(estimate.nominal_model.a[1], a2, 1e-3);
}

}  // namespace
}  // namespace uncertainty_identification
