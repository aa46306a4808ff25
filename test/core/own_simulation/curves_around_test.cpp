// Curves before and behind a simulation that no linear model describes.
#include "own_simulation/curves_around.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "own_simulation/examine.h"
#include "support/own_machine.h"

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
    ++runs;
    if (refuses_small_inputs && (input.u.array() == 0).any())
      return Eigen::VectorXd::Constant(input.u.size(), std::nan(""));
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
  int runs = 0;
};

using CurveOfInput = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

CurveOfInput eachBy(const std::function<double(double)>& curve) {
  return
      [curve](const Eigen::VectorXd& signal) -> Eigen::VectorXd { return signal.unaryExpr(curve); };
}

double deadZone(double u) { return u > 0.4 ? u - 0.4 : u < -0.4 ? u + 0.4 : 0; }

/// The last six experiments are held out.
OwnSimulationFindings examined(StickingMotor& motor, std::vector<Experiment> all,
                               const ExamineOptions& options = {}) {
  const std::vector<Experiment> held(all.end() - 6, all.end());
  all.resize(all.size() - 6);
  motor.runs = 0;
  return examine(motor, all, held, options);
}

OwnSimulationFindings found(const MachineOptions& options) {
  StickingMotor motor;
  return examined(motor, recordWithFactor(motor, -1, 1, options));
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
    const SimulationCause& cause = asymmetric.structure.causes.at(0);
    EXPECT_NEAR(cause.values.at(0).value, -0.3, 0.01);
    EXPECT_NE(cause.description.find(sign > 0 ? "zero, above it" : "zero, below it"),
              std::string::npos)
        << cause.description;
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
  const OwnSimulationFindings cubic = found(options);
  expectCurve(cubic, "sens_wiener");
  EXPECT_NEAR(cubic.structure.causes.at(0).values.at(0).value, 0.02, 0.002);
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

TEST(CurvesAround, ALimitOfTheSensor) {
  MachineOptions options;
  options.output_change = [](const Eigen::VectorXd& y, int) -> Eigen::VectorXd {
    return y.cwiseMin(1.5).cwiseMax(-1.5);
  };
  const OwnSimulationFindings clipped = found(options);
  expectCurve(clipped, "sens_clip");
  expectValue(clipped, "limit", 1.5);
}

TEST(CurvesAround, MissingSamplesAreNotCompared) {
  StickingMotor motor;
  std::vector<Experiment> all = recordWithFactor(motor, -1, 1, withInput(eachBy(deadZone)));
  for (Experiment& each : all) {
    each.valid.assign(static_cast<std::size_t>(each.samples()), 1);
    for (int k = 40; k < 60; ++k) {
      each.valid[static_cast<std::size_t>(k)] = 0;
      each.y[k] = std::nan("");
    }
  }
  expectCurve(examined(motor, all), "act_deadzone");
}

TEST(CurvesAround, NeverRunsMoreOftenThanItMay) {
  StickingMotor motor;
  const auto all = recordWithFactor(motor, -1, 1, withInput(eachBy(deadZone)));
  for (const bool refuses : {false, true}) {
    motor.refuses_small_inputs = refuses;
    for (const int most : {40, 200, 700, 2000}) {
      ExamineOptions options;
      options.max_simulations = most;
      const OwnSimulationFindings limited = examined(motor, all, options);
      EXPECT_LE(motor.runs, most);
      EXPECT_EQ(limited.simulations, motor.runs);
      if (most < 2000) EXPECT_TRUE(limited.ended_early) << most;
    }
  }
}

TEST(CurvesAround, EndsWhenItIsCancelled) {
  StickingMotor motor;
  const auto all = recordWithFactor(motor, -1, 1, withInput(eachBy(deadZone)));
  for (const int at : {100, 1010, 1100, 1300}) {
    ExamineOptions options;
    options.progress = [&](const std::string&) { return motor.runs < at; };
    EXPECT_TRUE(examined(motor, all, options).ended_early) << at;
    EXPECT_LT(motor.runs, at + 60) << "no more than one pass over the experiments and its slopes";
  }
}

TEST(CurvesAround, NoneByFewSteps) {
  StickingMotor motor;
  std::vector<Experiment> all = recordWithFactor(motor, -1, 1, {});
  all.resize(5);
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].u.setConstant(1 + 0.5 * static_cast<double>(k));
    SimulationInput input = inputOf(all[k]);
    input.u = input.u.unaryExpr(&deadZone);
    all[k].y = motor.run(input, Eigen::Vector2d(2, 1));
  }
  const std::vector<Experiment> held(all.end() - 1, all.end());
  all.pop_back();
  EXPECT_TRUE(examine(motor, all, held, {}).structure.causes.empty());
}

TEST(CurvesAround, AnInputThatTheSimulationRefusesSaysNothing) {
  StickingMotor motor;
  MachineOptions options;
  options.output_change = [](const Eigen::VectorXd& y, int) -> Eigen::VectorXd {
    return y + 0.02 * y.array().cube().matrix();
  };
  const std::vector<Experiment> all = recordWithFactor(motor, -1, 1, options);
  motor.refuses_small_inputs = true;  // a dead zone makes some
  expectCurve(examined(motor, all), "sens_wiener");
}

}  // namespace
}  // namespace uncertainty_identification
