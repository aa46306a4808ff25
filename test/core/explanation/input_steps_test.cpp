// Steps of the actuator that the residuals of a linear model show.
#include "explanation/input_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "support/fit_setup.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {
namespace {

/// What a linear plant answers to a command, from rest.
Eigen::VectorXd answer(const dense::Model& plant, const Eigen::VectorXd& u) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(u.size());
  for (Eigen::Index t = 0; t < u.size(); ++t) {
    for (Eigen::Index k = 0; k < plant.b.size(); ++k)
      if (t - plant.delay - k >= 0) x[t] += plant.b[k] * u[t - plant.delay - k];
    for (Eigen::Index k = 0; k < plant.a.size(); ++k)
      if (t - 1 - k >= 0) x[t] -= plant.a[k] * x[t - 1 - k];
  }
  return x;
}

/// The paper's Example 1 with an actuator that does this with its command.
test::RandomSystem movedBy(const std::function<double(double)>& actuator) {
  test::RandomSystem system = test::example1(2, 30);
  for (Experiment& experiment : system.experiments)
    experiment.y += answer(system.truth, experiment.u.unaryExpr(actuator) - experiment.u);
  return system;
}

test::RandomSystem movedInSteps(double step, double level) {
  return movedBy([=](double u) { return level + step * std::round((u - level) / step); });
}

DataSummary foundIn(const test::RandomSystem& system) {
  const FitData data = test::example1Data(system.experiments);
  const Fit fit = test::fitOfTruth(system.truth, test::example1Configuration(), data);
  DataSummary summary = summarise(data.experiments());
  findInputSteps(residualsOf(fit, data), fit, data, &summary);
  return summary;
}

DataSummary foundOf(double step, double level) { return foundIn(movedInSteps(step, level)); }

TEST(InputSteps, AreFoundWhereverTheyBegin) {
  const double deviation = foundOf(1e-6, 0).input_deviation;
  for (const double step : {0.4 * deviation, deviation})
    for (const double level : {0.0, 0.3 * step}) {
      const DataSummary found = foundOf(step, level);
      EXPECT_NEAR(found.input_step, step, 0.002 * step);
      EXPECT_NEAR(std::remainder(found.input_level - level, step), 0, 0.02 * step);
    }
}

TEST(InputSteps, AreNotFoundWhereThereAreNone) { EXPECT_EQ(foundOf(1e-6, 0).input_step, 0); }

/// As of a gear that runs out of round, of the size that rounding leaves.
TEST(InputSteps, AreNoRipple) {
  const double turn = foundOf(1e-6, 0).input_deviation;
  const DataSummary found =
      foundIn(movedBy([=](double u) { return u - turn / M_PI * std::sin(2 * M_PI * u / turn); }));
  EXPECT_EQ(found.input_step, 0);
}

/// Of a command of few levels, any function is a line or a curve.
TEST(InputSteps, AreNotLookedForInFewLevels) {
  test::RandomSystem system = movedInSteps(1, 0.3);
  for (Experiment& experiment : system.experiments)
    experiment.u = experiment.u.unaryExpr([](double u) { return std::round(u); });
  const FitData data = test::example1Data(system.experiments);
  const Fit fit = test::fitOfTruth(system.truth, test::example1Configuration(), data);
  DataSummary summary = summarise(data.experiments());
  findInputSteps(residualsOf(fit, data), fit, data, &summary);
  EXPECT_EQ(summary.input_step, 0);
}

/// Runs of a heater of the first order, whose gain differs a little, at a command of about 40 that
/// it follows in steps; sampled once in a fifth of its time constant, or `fast` times as often.
std::vector<Experiment> heaterInSteps(double step, double level, std::size_t runs = 16,
                                      int fast = 1) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  std::vector<Experiment> all(runs);
  for (Experiment& each : all) {
    each.id = "run_" + std::to_string(&each - all.data());
    each.sample_time = 1. / fast;
    each.u.resize(200 * fast);
    each.y.resize(200 * fast);
    const double gain = 1 + 0.03 * normal(engine);
    double x = 40, slow = 0;
    for (int t = 0; t < 200 * fast; ++t) {
      slow += 0.9 / std::sqrt(fast) * normal(engine) - 0.1 / fast * slow;
      each.u[t] = 40 + slow;
      each.y[t] = gain * x + 0.02 * normal(engine);
      x += 0.2 / fast * (level + step * std::round((each.u[t] - level) / step) - x);
    }
  }
  return all;
}

/// The whole way: the cause is named with its values, and has no rival in its other form.
TEST(InputSteps, AreNamedWithTheirLevel) {
  Configuration configuration;
  configuration.nominal_model.orders_auto = false;
  const Explanation found = explain(configuration, heaterInSteps(1.3, 40.4));
  ASSERT_EQ(found.causes.size(), 1u) << found.message;
  const Cause& cause = found.causes.front();
  EXPECT_EQ(cause.name, "act_quantisation");
  EXPECT_EQ(cause.variant, "shifted");
  EXPECT_TRUE(cause.equivalent.empty());
  EXPECT_NEAR(cause.parameters.at(0).value, 1.3, 0.02);
  EXPECT_NEAR(std::remainder(cause.parameters.at(1).value - 40.4, 1.3), 0, 0.1);
}

/// Long records that are sampled fast are averaged, and averages of steps are none.
TEST(InputSteps, AreNotAveragedAway) {
  Configuration configuration;
  configuration.nominal_model.orders_auto = false;
  configuration.explanation.time_limit = 120;  // thinned as by default, with time for all samples
  const Explanation found = explain(configuration, heaterInSteps(1.3, 40.4, 8, 6));
  const auto steps = std::find_if(found.causes.begin(), found.causes.end(), [](const Cause& cause) {
    return cause.name == "act_quantisation";
  });
  ASSERT_NE(steps, found.causes.end()) << found.message;
  EXPECT_NEAR(steps->parameters.at(0).value, 1.3, 0.01);
}

}  // namespace
}  // namespace uncertainty_identification
