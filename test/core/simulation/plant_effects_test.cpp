#include "simulation/plant_effects.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/hidden.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using test::expectNear;
using test::unitDelay;
using test::vectorOf;

/// x(t) = 0.6 x(t - 1) + 0.5 f(t - 1) with f = drive(u, x, x before).
template <class Drive>
VectorXd looped(const VectorXd& u, Drive drive) {
  VectorXd x = VectorXd::Zero(u.size());
  double f = 0;
  for (int t = 0; t < u.size(); ++t) {
    if (t > 0) x(t) = 0.6 * x(t - 1) + 0.5 * f;
    f = drive(u(t), x(t), t > 0 ? x(t - 1) : 0);
  }
  return x;
}

Truth firstOrder() {
  Truth truth = unitDelay();
  truth.plant.b = vectorOf({0.5});
  truth.plant.a = vectorOf({-0.6});
  return truth;
}

TEST(PlantEffects, Pole) {
  Truth truth = unitDelay();
  truth.effects.plant.pole = {0.8};
  const Experiment experiment = simulateExperiment(truth, 1, 0);
  double x = 0;
  for (int t = 1; t < 200; ++t) {
    x = 0.8 * x + 0.2 * experiment.u(t - 1);
    EXPECT_NEAR(experiment.y(t), x, 1e-12);
  }
}

TEST(PlantEffects, ResonanceStandsInParallel) {
  Truth truth = unitDelay();
  truth.effects.plant.resonance = {0.9, 0.7, 0.3, -0.1};
  const Experiment experiment = simulateExperiment(truth, 1, 0);
  VectorXd mode = VectorXd::Zero(200);
  for (int t = 1; t < 200; ++t) {
    mode(t) = 2 * 0.9 * std::cos(0.7) * mode(t - 1) + 0.3 * experiment.u(t - 1);
    if (t > 1) mode(t) += -0.81 * mode(t - 2) - 0.1 * experiment.u(t - 2);
    EXPECT_NEAR(experiment.y(t), experiment.u(t - 1) + mode(t), 1e-11);
  }
}

TEST(PlantEffects, FeedbackWithinThePlant) {
  Truth cubic = firstOrder(), coulomb = firstOrder(), bilinear = firstOrder(),
        gravity = firstOrder(), outflow = firstOrder();
  cubic.effects.plant.cubic = {0.2};
  coulomb.effects.plant.coulomb = {0.4, 0.05};
  bilinear.effects.unnamed.bilinear = {0.3};
  gravity.effects.unnamed.gravity = {0.4, 0.5};
  outflow.effects.unnamed.outflow = {0.3};
  const VectorXd u = simulateExperiment(firstOrder(), 2, 1).u;
  const auto output = [](const Truth& truth) { return simulateExperiment(truth, 2, 1).y; };
  expectNear(output(cubic),
             looped(u, [](double f, double x, double) { return f - 0.2 * x * x * x; }));
  expectNear(output(coulomb), looped(u, [](double f, double x, double before) {
               return f - 0.4 * std::tanh((x - before) / 0.05);
             }));
  expectNear(output(bilinear),
             looped(u, [](double f, double x, double) { return f + 0.3 * f * x; }));
  expectNear(output(gravity),
             looped(u, [](double f, double x, double) { return f - 0.4 * std::sin(x / 0.5); }));
  expectNear(output(outflow), looped(u, [](double f, double x, double) {
               return f - 0.3 * (x < 0 ? -1 : 1) * std::sqrt(std::abs(x));
             }));
}

TEST(PlantEffects, FeedbackOfZeroLeavesTheRelativeErrorAsItIs) {
  Truth truth = firstOrder();
  truth.error_model.mixture = {{1.0}, {vectorOf({0.3})}, {Eigen::MatrixXd::Constant(1, 1, 0.04)}};
  const Experiment plain = simulateExperiment(truth, 3, 0);
  truth.effects.plant.cubic = {0.0};
  expectNear(simulateExperiment(truth, 3, 0).y, plain.y);
}

TEST(PlantEffects, FeedbackWithinThePlantNeedsADelay) {
  Truth truth = firstOrder();
  truth.plant.delay = 0;
  EXPECT_NO_THROW(truth.validate());
  truth.effects.plant.coulomb.emplace();
  EXPECT_THROW(truth.validate(), ConfigurationError);
}

TEST(PlantEffects, DivergenceIsAnError) {
  Truth truth = firstOrder();
  truth.effects.plant.cubic = {5};
  EXPECT_THROW(simulate(truth, 1), ConfigurationError);
}

TEST(PlantEffects, DriftOfTheGain) {
  Truth truth = unitDelay();
  truth.effects.plant.drift = {0.8};
  const Experiment experiment = simulateExperiment(truth, 1, 0);
  for (int t = 1; t < 200; ++t)
    EXPECT_NEAR(experiment.y(t), experiment.u(t - 1) * (1 + 0.8 * ((t - 1) / 200.0 - 0.5)), 1e-12);
}

TEST(PlantEffects, TemperatureChangesTheGainAndIsRecorded) {
  Truth truth = unitDelay();
  const Experiment plain = simulateExperiment(truth, 1, 2);
  EXPECT_TRUE(plain.signals.empty());
  truth.effects.plant.temp = {0.3, 15};
  const Experiment experiment = simulateExperiment(truth, 1, 2);
  const VectorXd& temp = experiment.signals.at("temp");
  for (int t = 1; t < 200; ++t)
    EXPECT_NEAR(experiment.y(t), plain.u(t - 1) * (1 + 0.03 * (temp(t - 1) - 15)), 1e-12);
}

TEST(PlantEffects, TemperatureHasItsMeanAndDeviation) {
  Truth truth = unitDelay(50);
  truth.covariates.temp = truth.covariates.d = true;
  truth.experiments = 4000;
  VectorXd temp(truth.experiments), d(truth.experiments);
  for (int r = 0; r < truth.experiments; ++r) {
    const Experiment experiment = simulateExperiment(truth, 1, r);
    temp(r) = experiment.signals.at("temp")(49);
    d(r) = experiment.signals.at("d")(49);
    EXPECT_EQ(experiment.y, simulateExperiment(unitDelay(50), 1, r).y);  // decoys
  }
  const auto variance = [](const VectorXd& x) { return (x.array() - x.mean()).square().mean(); };
  // Four standard errors of mean and variance.
  EXPECT_NEAR(temp.mean(), 20, 0.37);
  EXPECT_NEAR(variance(temp), 34, 4 * 34 * std::sqrt(2.0 / 4000));
  EXPECT_NEAR(d.mean(), 0, 0.064);
  EXPECT_NEAR(variance(d), 1, 4 * std::sqrt(2.0 / 4000));
}

TEST(PlantEffects, InitialStateRingsDownByA) {
  Truth truth = firstOrder();
  const Experiment plain = simulateExperiment(truth, 1, 1);
  truth.effects.plant.init = {2};
  const double c = drawSystem(truth, 1, 1).effects.initial_state;
  EXPECT_NE(c, 0);
  const VectorXd added = simulateExperiment(truth, 1, 1).y - plain.y;
  for (int t = 0; t < 50; ++t) EXPECT_NEAR(added(t), c * std::pow(0.6, t), 1e-12);
}

TEST(PlantEffects, AgingMovesTheMeanFromTheFirstToTheLast) {
  Truth truth = firstOrder();
  truth.error_model.mixture = {{1.0}, {vectorOf({0.3})}, {Eigen::MatrixXd::Constant(1, 1, 0.04)}};
  Truth aging = truth;
  aging.effects.plant.aging = {vectorOf({0.8})};
  for (int r = 0; r < 3; ++r) {
    const double moved = drawSystem(aging, 5, r).xi(0) - drawSystem(truth, 5, r).xi(0);
    EXPECT_NEAR(moved, 0.4 * (r - 1), 1e-12);
  }
  aging.effects.plant.aging = {vectorOf({0.8, 1})};
  EXPECT_THROW(aging.validate(), ConfigurationError);
}

TEST(PlantEffects, ParameterSpread) {
  Truth truth = firstOrder();
  truth.experiments = 4000;
  truth.effects.plant.parameter_spread = {"a1", 0.2};
  VectorXd deviation(4000);
  for (int r = 0; r < 4000; ++r) {
    const DrawnSystem system = drawSystem(truth, 1, r);
    deviation(r) = system.effects.parameter_deviation;
    EXPECT_NEAR(system.polynomials.a(0), -0.6 * (1 + deviation(r)), 1e-14);
    EXPECT_EQ(system.polynomials.b, truth.plant.b);
    ASSERT_LT(std::abs(system.polynomials.a(0)), 1);
  }
  // 0.04 % of the normal distribution lie beyond the unit circle; four standard errors.
  EXPECT_NEAR(deviation.mean(), 0, 0.013);
  EXPECT_NEAR(deviation.squaredNorm() / 4000, 0.04, 0.0036);
  truth.effects.plant.parameter_spread->parameter = "a2";
  EXPECT_THROW(truth.validate(), ConfigurationError);
  truth.plant.structure = PlantStructure::first_order;
  truth.effects.plant.parameter_spread->parameter = "time_constant";
  truth.validate();
  const DrawnSystem system = drawSystem(truth, 1, 0);
  EXPECT_NEAR(system.time_constant.value(), 1 + system.effects.parameter_deviation, 1e-14);
  EXPECT_NEAR(system.polynomials.a(0), -std::exp(-1 / *system.time_constant), 1e-14);
}

}  // namespace
}  // namespace uncertainty_identification
