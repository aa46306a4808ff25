// Tests of predictions beside the checks of the residuals.
#include "explanation/prediction_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "support/heater_under_control.h"

namespace uncertainty_identification {
namespace {

/// Residuals of which a tenth of the variance follows the input.
ResidualTests dependent(double p_value) {
  ResidualTests tests;
  tests.samples = 1000;
  tests.cross_correlation = {0.3};
  tests.independence_p_value = p_value;
  tests.whiteness_p_value = tests.linearity_p_value = 0.5;
  return tests;
}

TEST(PredictionChecks, FailWhereIdentifyWouldNotRelyOnTheModel) {
  Explanation explanation;
  explanation.before.residual_tests = dependent(1e-9);
  explanation.after.residual_tests = dependent(0.2);
  addFailedPredictions(&explanation);
  ASSERT_EQ(explanation.checks_before.size(), 1u);
  ASSERT_EQ(explanation.checks_after.size(), 1u);
  EXPECT_EQ(explanation.checks_before[0].name, "dependence on the input of predictions");
  EXPECT_FALSE(explanation.checks_before[0].passed);
  EXPECT_EQ(explanation.checks_before[0].p_value, 1e-9);
  EXPECT_TRUE(explanation.checks_after[0].passed);
}

TEST(PredictionChecks, AreNotAddedWhereAllPass) {
  Explanation explanation;  // many data sets are explained: one in a thousand fails by chance
  explanation.before.residual_tests = explanation.after.residual_tests = dependent(1e-4);
  addFailedPredictions(&explanation);
  EXPECT_TRUE(explanation.checks_before.empty());
  EXPECT_TRUE(explanation.checks_after.empty());
}

/// The eight runs of test/data/regressions/servo_under_its_controller: an axis that integrates
/// (40 degrees per second and volt, behind a lag of 0.08 s and a dead zone of 0.6 V), moved by a
/// controller from rest to a setpoint. The input is what the controller asks for.
std::vector<Experiment> servoRuns() {
  std::vector<Experiment> runs;
  for (int run = 0; run < 8; ++run) {
    std::ifstream file(TEST_DATA "/regressions/servo_under_its_controller/exp_00" +
                       std::to_string(run) + ".csv");
    std::vector<double> u, y;
    double time = 0, input = 0, output = 0;
    for (std::string line; std::getline(file, line);) {
      if (std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &input, &output) != 3) continue;
      u.push_back(input);
      y.push_back(output);
    }
    Experiment experiment;
    experiment.id = std::to_string(run);
    experiment.sample_time = 0.04;
    experiment.u = Eigen::Map<Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size()));
    experiment.y = Eigen::Map<Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
    runs.push_back(std::move(experiment));
  }
  return runs;
}

// The setpoint is constant in each run, so that the output is also a linear function of the input,
// by the inverse of the controller: a model of that has white residuals and fits by 99.9 %. One of
// the models tried cannot be evaluated, which must not end the search.
TEST(PredictionChecks, AServoUnderItsControllerDoesNotAgreeWithALinearPlant) {
  const std::vector<Experiment> runs = servoRuns();
  ASSERT_EQ(runs.front().samples(), 90);
  Configuration configuration;
  configuration.nominal_model.orders_auto = true;
  const Explanation found = explain(configuration, {runs.begin(), runs.end() - 1}, {runs.back()});
  EXPECT_EQ(found.verdict, Verdict::unknown) << found.message;
  EXPECT_TRUE(found.causes.empty());
}

TEST(PredictionChecks, TheInverseOfAControllerIsNeitherNoneNorExplained) {
  Configuration configuration;
  configuration.explanation.time_limit = 0;
  const Explanation explanation = explain(configuration, {test::heaterUnderControl()});
  EXPECT_NE(explanation.verdict, Verdict::none);
  EXPECT_NE(explanation.verdict, Verdict::explained);
  const auto is_direction = [](const Check& each) { return each.name == "direction"; };
  EXPECT_TRUE(
      std::any_of(explanation.checks_after.begin(), explanation.checks_after.end(), is_direction));
}

}  // namespace
}  // namespace uncertainty_identification
