// Curves before and behind a simulation that no linear model describes.
#include "own_simulation/curves_around.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "own_simulation/examine.h"
#include "support/own_machine.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// A motor with much Coulomb friction, of which a linear model fits about 80 %: speed' = (gain u -
/// speed - friction sign(speed)) / 0.2 s.
class StickingMotor : public Simulation {
 public:
  std::string description() const override { return "the sticking motor"; }
  std::vector<SimulationParameter> parameters() const override {
    return {{"gain", 2, ""}, {"friction", 1, ""}};
  }
  bool canRerun() const override { return true; }
  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override {
    if (refuses_small_inputs && (input.u.array() == 0).any())
      throw DataError("the input must not be zero");
    constexpr int kSteps = 20;
    const double step = input.sample_time / kSteps / 0.2;
    Eigen::VectorXd y(input.u.size());
    double speed = 0;
    for (Eigen::Index k = 0; k < y.size(); ++k) {
      y[k] = speed;
      for (int i = 0; i < kSteps; ++i)
        speed += step * (values[0] * input.u[k] - speed - values[1] * std::tanh(speed / 0.1));
    }
    return y;
  }
  bool refuses_small_inputs = false;
};

using CurveOfInput = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

CurveOfInput eachBy(const std::function<double(double)>& curve) {
  return
      [curve](const Eigen::VectorXd& signal) -> Eigen::VectorXd { return signal.unaryExpr(curve); };
}

double deadZone(double u) { return u > 0.4 ? u - 0.4 : u < -0.4 ? u + 0.4 : 0; }

OwnSimulationFindings found(const MachineOptions& options, int max_simulations = 2000) {
  StickingMotor motor;
  std::vector<Experiment> all = recordWithFactor(motor, -1, 1, options);
  const std::vector<Experiment> held(all.end() - 6, all.end());
  all.resize(all.size() - 6);
  ExamineOptions how;
  how.max_simulations = max_simulations;
  return examine(motor, all, held, how);
}

MachineOptions withInput(const CurveOfInput& curve) {
  MachineOptions options;
  options.input_curve = curve;
  return options;
}

void expectCurve(const OwnSimulationFindings& found, const std::string& name) {
  ASSERT_EQ(found.structure.causes.size(), 1u) << found.sentence;
  EXPECT_TRUE(found.has_curve_around) << found.sentence;
  EXPECT_EQ(found.structure.causes[0].what.name, name) << found.sentence;
  EXPECT_GT(found.fit_after, 96) << "the noise is left: 30 dB";
  EXPECT_LT(found.fit_before, found.fit_after - 2);
}

void expectValue(const OwnSimulationFindings& found, const std::string& name, double truth) {
  const ShapeValue& value = found.structure.causes.at(0).values.at(0);
  EXPECT_EQ(value.name, name);
  EXPECT_NEAR(value.value, truth, 0.02 * truth);
  EXPECT_LT(value.standard_error, 0.02 * truth);
}

TEST(CurvesAround, ADeadZoneBesideFrictionThatCouldStandForIt) {
  const OwnSimulationFindings dead = found(withInput(eachBy(deadZone)));
  expectCurve(dead, "act_deadzone");
  expectValue(dead, "half_width", 0.4);
  EXPECT_TRUE(dead.causes.empty()) << dead.sentence;
}

/// 3.1 is reached by the input in a twenty-fifth of the time.
TEST(CurvesAround, ALimitOfTheInput) {
  for (const double limit : {1.2, 3.1}) {
    const auto limited = [limit](double u) { return std::min(std::max(u, -limit), limit); };
    const OwnSimulationFindings saturated = found(withInput(eachBy(limited)));
    expectCurve(saturated, "act_saturation");
    expectValue(saturated, "limit", limit);
  }
}

TEST(CurvesAround, AnotherGainForEitherSign) {
  for (const double sign : {1.0, -1.0}) {
    const auto weaker = [sign](double u) { return sign * u > 0 ? 0.7 * u : u; };
    const OwnSimulationFindings asymmetric = found(withInput(eachBy(weaker)));
    expectCurve(asymmetric, "act_asymmetry");
    EXPECT_NEAR(asymmetric.structure.causes.at(0).values.at(0).value, -0.3, 0.01);
  }
}

TEST(CurvesAround, AGainThatDrifts) {
  const auto drifting = [](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    return u.cwiseProduct(Eigen::VectorXd::LinSpaced(u.size(), 0.8, 1.2));
  };
  const OwnSimulationFindings drift = found(withInput(drifting));
  expectCurve(drift, "plant_drift");
  expectValue(drift, "amplitude", 0.4);
}

TEST(CurvesAround, ACurveOfTheSensor) {
  MachineOptions options;
  options.output_change = [](const Eigen::VectorXd& y, int) -> Eigen::VectorXd {
    return y + 0.02 * y.array().cube().matrix();
  };
  expectCurve(found(options), "sens_wiener");
}

TEST(CurvesAround, NothingAroundAPerfectSimulation) {
  for (const double spread : {0.0, 0.05}) {
    MachineOptions options;
    options.spread = spread;
    const OwnSimulationFindings perfect = found(options);
    EXPECT_TRUE(perfect.structure.causes.empty()) << perfect.sentence;
    EXPECT_NE(perfect.structure.skipped.find("before and behind it, but not inside it"),
              std::string::npos)
        << perfect.structure.skipped;
  }
}

TEST(CurvesAround, NeverRunsMoreOftenThanItMay) {
  for (const int most : {40, 200, 700}) {
    const OwnSimulationFindings limited = found(withInput(eachBy(deadZone)), most);
    EXPECT_LE(limited.simulations, most);
    EXPECT_TRUE(limited.ended_early) << most;
  }
}

TEST(CurvesAround, AnInputThatTheSimulationRefusesSaysNothing) {
  StickingMotor motor;
  MachineOptions options;
  options.output_change = [](const Eigen::VectorXd& y, int) -> Eigen::VectorXd {
    return y + 0.02 * y.array().cube().matrix();
  };
  std::vector<Experiment> all = recordWithFactor(motor, -1, 1, options);
  motor.refuses_small_inputs = true;  // a dead zone makes some
  const std::vector<Experiment> held(all.end() - 6, all.end());
  all.resize(all.size() - 6);
  expectCurve(examine(motor, all, held, {}), "sens_wiener");
}

}  // namespace
}  // namespace uncertainty_identification
