// Which of two simulations is worse, and the plant in the middle of a distribution.
#include "identification/mean_plant.h"

#include <gtest/gtest.h>

#include <cmath>

#include "identification/steps.h"
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

}  // namespace
}  // namespace uncertainty_identification
