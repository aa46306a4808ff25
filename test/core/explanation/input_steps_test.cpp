// Steps of the actuator that the residuals of a linear model show.
#include "explanation/input_steps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/fit_setup.h"

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

/// What is found where the actuator of the paper's Example 1 moves in steps.
DataSummary foundOf(double step, double level) {
  test::RandomSystem system = test::example1(2, 30);
  for (Experiment& experiment : system.experiments) {
    const Eigen::VectorXd rounded = experiment.u.unaryExpr(
        [&](double u) { return level + step * std::round((u - level) / step); });
    experiment.y += answer(system.truth, rounded - experiment.u);
  }
  const FitData data = test::example1Data(system.experiments);
  const Fit fit = test::fitOfTruth(system.truth, test::example1Configuration(), data);
  DataSummary summary = summarise(data.experiments());
  findInputSteps(residualsOf(fit, data), fit, data, &summary);
  return summary;
}

TEST(InputSteps, AreFoundWhereverTheyBegin) {
  const double deviation = foundOf(1e-6, 0).input_deviation;
  for (const double step : {0.4 * deviation, deviation})
    for (const double level : {0.0, 0.3 * step}) {
      const DataSummary found = foundOf(step, level);
      EXPECT_NEAR(found.input_step, step, 0.01 * step);
      EXPECT_NEAR(std::remainder(found.input_level - level, step), 0, 0.1 * step);
    }
}

TEST(InputSteps, AreNotFoundWhereThereAreNone) { EXPECT_EQ(foundOf(1e-6, 0).input_step, 0); }

}  // namespace
}  // namespace uncertainty_identification
