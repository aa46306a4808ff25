// Curves before and behind a simulation whose output is its input.
#include "own_simulation/surrounding_curve.h"

#include <gtest/gtest.h>

#include "own_simulation/logged_simulation.h"
#include "own_simulation/simulation_comparison.h"

namespace uncertainty_identification {
namespace {

SimulationCause causeAt(const std::string& place, const std::string& shape,
                        std::vector<ShapeValue> values) {
  SimulationCause cause;
  cause.what = {"cause", place, shape, "load"};
  cause.values = std::move(values);
  return cause;
}

/// A cause that is only drawn: 1 + signal^2 at -1, 0 and 1.
SimulationCause drawnAt(const std::string& place) {
  SimulationCause cause = causeAt(place, "square", {{"amplitude", 1, 0}});
  cause.curve.signal = {-1, 0, 1};
  cause.curve.value = {2, 1, 2};
  return cause;
}

/// Its output is its input, times a parameter.
class Wire : public Simulation {
 public:
  std::string description() const override { return "the wire"; }
  std::vector<SimulationParameter> parameters() const override { return {{"gain", 2, "V"}}; }
  bool canRerun() const override { return true; }
  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override {
    return values[0] * input.u;
  }
};

Eigen::VectorXd five(double a, double b, double c, double d, double e) {
  return (Eigen::VectorXd(5) << a, b, c, d, e).finished();
}

Eigen::VectorXd through(const SimulationCause& cause) {
  Wire wire;
  SimulationInput input;
  input.u = five(-3, -0.4, 0, 0.7, 2);
  input.signals["load"] = five(0, 0.5, 1, -1, 4);
  return withCurve(wire, surroundingCurve(cause)->curve)
      ->run(input, Eigen::VectorXd::Constant(1, 1));
}

TEST(SurroundingCurve, DeadZonesAndLimitsHaveTheirOwnValues) {
  const auto with = [](const std::string& shape, std::vector<ShapeValue> values) {
    return through(causeAt("input", shape, std::move(values)));
  };
  EXPECT_TRUE(with("dead_zone", {{"half_width", 0.5, 0.01}}).isApprox(five(-2.5, 0, 0, 0.2, 1.5)));
  EXPECT_TRUE(with("dead_zone", {{"half_width", -0.5, 0.01}}).isApprox(five(-2.5, 0, 0, 0.2, 1.5)))
      << "a width has no sign";
  EXPECT_TRUE(with("saturation", {{"limit", 1.5, 0}}).isApprox(five(-1.5, -0.4, 0, 0.7, 1.5)));
  EXPECT_TRUE(with("dead_zone_saturation", {{"half_width", 0.5, 0}, {"limit", 1, 0}})
                  .isApprox(five(-1, 0, 0, 0.2, 1)));
  EXPECT_TRUE(with("asymmetric_dead_zone", {{"width_above", 0.5, 0}, {"width_below", 1, 0}})
                  .isApprox(five(-2, 0, 0, 0.2, 1.5)));
  EXPECT_TRUE(surroundingCurve(causeAt("input", "dead_zone", {{"half_width", 1, 0}}))->is_to_scale);
}

/// A curve without a shape, which ends where the data end.
SimulationCause freeAt(const std::string& place) {
  SimulationCause cause = drawnAt(place);
  cause.what.shape = "curve";
  return cause;
}

TEST(SurroundingCurve, OthersAreDrawn) {
  EXPECT_TRUE(through(drawnAt("input")).isApprox(five(4, 1.4, 1, 1.7, 3)));
  EXPECT_TRUE(through(freeAt("sensor")).isApprox(five(0, 1.4, 1, 1.7, 3)));
  EXPECT_TRUE(through(freeAt("covariate_gain")).isApprox(five(-6, -1, 0, 2.1, 6)))
      << "1 + value at the covariate; constant beyond the data";
  EXPECT_TRUE(through(drawnAt("time_gain")).isApprox(five(-6, -0.9, 0, 1.925, 6)))
      << "1 + value at 0, 0.25, 0.5, 0.75, 1";
  EXPECT_FALSE(surroundingCurve(drawnAt("sensor"))->is_to_scale);
}

TEST(SurroundingCurve, ThereIsNoneInsideThePlant) {
  EXPECT_FALSE(surroundingCurve(drawnAt("rate")));
  EXPECT_FALSE(surroundingCurve(causeAt("input", "curve", {}))) << "nothing was drawn";
}

/// Experiments of the wire behind a curve that is 1.5 times as large and 0.2 higher.
TEST(SurroundingCurve, IsScaledToTheSimulation) {
  Wire wire;
  const OwnCurve drawn = surroundingCurve(drawnAt("input"))->curve;
  OwnCurve truth = drawn;
  for (double& value : truth.value) value = 1.5 * value + 0.2;
  std::vector<Experiment> experiments(3);
  for (std::size_t k = 0; k < experiments.size(); ++k) {
    experiments[k].id = std::to_string(k);
    experiments[k].sample_time = 0.1;
    experiments[k].u = Eigen::VectorXd::LinSpaced(60, -1.5, 1.5 + static_cast<double>(k));
    experiments[k].y = 2 * valuesAt(truth, experiments[k].u);
  }
  int count = 0;
  const OwnCurve scaled =
      scaledTo(wire, drawn, comparedData(experiments, 0, 1), 1000, nullptr, &count);
  for (std::size_t k = 0; k < scaled.value.size(); ++k)
    EXPECT_NEAR(scaled.value[k], truth.value[k], 1e-3);
  EXPECT_GT(count, 0);
}

/// The same where the curve is behind a wire whose own gain is too small.
TEST(SurroundingCurve, BehindTheSimulationWhatGoesInIsScaled) {
  Wire wire;
  const OwnCurve drawn = surroundingCurve(drawnAt("sensor"))->curve;
  std::vector<Experiment> experiments(1);
  experiments[0].sample_time = 0.1;
  experiments[0].u = Eigen::VectorXd::LinSpaced(90, -1, 1);
  experiments[0].y = valuesAt(drawn, (3 * experiments[0].u.array() - 0.1).matrix());
  int count = 0;
  const OwnCurve scaled =
      scaledTo(wire, drawn, comparedData(experiments, 0, 1), 1000, nullptr, &count);
  for (std::size_t k = 0; k < scaled.value.size(); ++k)
    EXPECT_NEAR(scaled.signal[k], (drawn.signal[k] + 0.1) / 1.5, 1e-3);
  EXPECT_EQ(scaled.value, drawn.value);
}

TEST(CompareWithCurve, NeedsASimulationThatCanBeRunWithAnotherInput) {
  const auto logged = makeLoggedSimulation("y_sim", "the column y_sim");
  EXPECT_FALSE(
      compareWithCurve(*logged, causeAt("input", "dead_zone", {{"half_width", 1, 0}}), {}, 1000));
}

TEST(CompareWithCurve, IsLeftOutWhereTooFewRunsAreLeft) {
  Wire wire;
  Experiment experiment;
  experiment.u = experiment.y = Eigen::VectorXd::LinSpaced(30, -1, 1);
  const std::vector<Experiment> experiments(5, experiment);
  ComparisonTask task;
  task.fitted = comparedData(experiments, 0, 1);
  task.held = task.fitted;
  const auto curved =
      compareWithCurve(wire, causeAt("input", "dead_zone", {{"half_width", 1, 0}}), task, 9);
  ASSERT_TRUE(curved.has_value());
  EXPECT_EQ(curved->comparison, nullptr);
  EXPECT_TRUE(curved->endedEarly());
  EXPECT_EQ(curved->simulations, 0);
}

}  // namespace
}  // namespace uncertainty_identification
