#include "own_simulation/input_curve.h"

#include <gtest/gtest.h>

#include "own_simulation/logged_simulation.h"
#include "support/own_machine.h"

namespace uncertainty_identification {
namespace {

SimulationCause inputCause(const std::string& shape, std::vector<ShapeValue> values) {
  SimulationCause cause;
  cause.what = {"act", "input", shape, ""};
  cause.values = std::move(values);
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

Eigen::VectorXd through(const SimulationCause& cause) {
  Wire wire;
  SimulationInput input;
  input.u = (Eigen::VectorXd(5) << -3, -0.4, 0, 0.7, 2).finished();
  return behindInputCurve(wire, cause)->run(input, Eigen::VectorXd::Constant(1, 1));
}

TEST(BehindInputCurve, IsADeadZoneALimitOrBoth) {
  const auto expected = [](double a, double b, double c, double d, double e) -> Eigen::VectorXd {
    return (Eigen::VectorXd(5) << a, b, c, d, e).finished();
  };
  EXPECT_TRUE(through(inputCause("dead_zone", {{"half_width", 0.5, 0.01}}))
                  .isApprox(expected(-2.5, 0, 0, 0.2, 1.5)));
  EXPECT_TRUE(through(inputCause("saturation", {{"limit", 1.5, 0.01}}))
                  .isApprox(expected(-1.5, -0.4, 0, 0.7, 1.5)));
  EXPECT_TRUE(
      through(inputCause("dead_zone_saturation", {{"half_width", 0.5, 0.01}, {"limit", 1, 0.01}}))
          .isApprox(expected(-1, 0, 0, 0.2, 1)));
  EXPECT_TRUE(through(inputCause("dead_zone", {{"half_width", -0.5, 0.01}}))
                  .isApprox(expected(-2.5, 0, 0, 0.2, 1.5)))
      << "a width has no sign";
}

TEST(BehindInputCurve, HasTheParametersOfTheSimulation) {
  Wire wire;
  const auto behind = behindInputCurve(wire, inputCause("saturation", {{"limit", 1, 0}}));
  EXPECT_EQ(behind->description(), "the wire");
  ASSERT_EQ(behind->parameters().size(), 1u);
  EXPECT_EQ(behind->parameters()[0].name + behind->parameters()[0].unit, "gainV");
  EXPECT_TRUE(behind->canRerun());
  SimulationInput input;
  input.u = Eigen::Vector2d(0.5, 4);
  EXPECT_EQ(behind->run(input, Eigen::VectorXd::Constant(1, 3)), Eigen::Vector2d(1.5, 3));
}

TEST(BehindInputCurve, IsNoneWhereTheGainHasNoMeaningOrNothingCanBeRun) {
  Wire wire;
  EXPECT_EQ(behindInputCurve(wire, inputCause("curve", {})), nullptr);
  EXPECT_EQ(behindInputCurve(wire, inputCause("asymmetric_slope", {{"amplitude", 1, 0}})), nullptr);
  SimulationCause friction = inputCause("dead_zone", {{"half_width", 1, 0}});
  friction.what.place = "rate";
  EXPECT_EQ(behindInputCurve(wire, friction), nullptr);
  const auto logged = makeLoggedSimulation("y_sim", "the column y_sim");
  EXPECT_EQ(behindInputCurve(*logged, inputCause("dead_zone", {{"half_width", 1, 0}})), nullptr);
}

}  // namespace
}  // namespace uncertainty_identification
