// Machines whose simulation has one known flaw; support/own_machine.h.
#include "own_simulation/examine.h"

#include <gtest/gtest.h>

#include <cmath>

#include "own_simulation/describe_change.h"
#include "own_simulation/linear_simulation.h"
#include "own_simulation/logged_simulation.h"
#include "support/error_message.h"
#include "support/own_machine.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

std::unique_ptr<Simulation> linear(std::map<std::string, double> physical) {
  OwnModelOptions options;
  options.physical = std::move(physical);
  return makeLinearSimulation(factorsOf(options, MachineOptions().sample_time), "the model");
}

std::unique_ptr<Simulation> firstOrder() { return linear({{"gain", 1.0}, {"tau1", 0.1}}); }
std::unique_ptr<Simulation> secondOrder() {
  return linear({{"gain", 2.0}, {"omega1", 8.0}, {"zeta1", 0.4}});
}

ExamineOptions withoutStructure() {
  ExamineOptions options;
  options.structure = false;
  return options;
}

/// The last six experiments are held out.
OwnSimulationFindings examined(Simulation& simulation, std::vector<Experiment> experiments,
                               const ExamineOptions& options = withoutStructure()) {
  const std::vector<Experiment> held(experiments.end() - 6, experiments.end());
  experiments.resize(experiments.size() - 6);
  return examine(simulation, experiments, held, options);
}

/// The same where only the output of the simulation was logged.
OwnSimulationFindings examinedAsColumn(Simulation& simulation, std::vector<Experiment> experiments,
                                       const ExamineOptions& options = withoutStructure()) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(simulation.parameters().size()));
  for (Eigen::Index k = 0; k < values.size(); ++k)
    values[k] = simulation.parameters()[static_cast<std::size_t>(k)].value;
  for (Experiment& each : experiments)
    each.signals["y_sim"] = simulation.run(inputOf(each), values);
  const auto logged = makeLoggedSimulation("y_sim", "the column y_sim");
  return examined(*logged, experiments, options);
}

/// One cause of this name, whose value is right within three standard errors.
void expectOnly(const OwnSimulationFindings& found, const std::string& name, double value) {
  ASSERT_EQ(found.causes.size(), 1u) << found.sentence;
  const OwnCause& cause = found.causes[0];
  EXPECT_EQ(cause.name, name) << found.sentence;
  EXPECT_NEAR(cause.values.at(0).measured, value, 3 * cause.values[0].standard_error)
      << found.sentence;
  EXPECT_LT(cause.values[0].lower_95, cause.values[0].measured);
  EXPECT_GT(cause.values[0].upper_95, cause.values[0].measured);
  EXPECT_GT(found.fit_after, found.fit_before);
}

TEST(Examine, NamesAWrongGain) {
  const auto simulation = firstOrder();
  const OwnSimulationFindings found =
      examined(*simulation, recordWithFactor(*simulation, 0, 1.1, {}));
  expectOnly(found, "sim_parameter", 1.1);
  EXPECT_EQ(found.causes[0].parameter, "gain");
  EXPECT_GT(found.fit_after, 96);  // 96.8 % is what the noise leaves
  EXPECT_NE(found.sentence.find("Your simulation fits 90.4 % of runs not used for fitting; with "
                                "gain 10.06 +- 0.04 % higher it fits 96.9 %"),
            std::string::npos)
      << found.sentence;
  EXPECT_EQ(found.held_out.size(), 6u);
  EXPECT_NEAR(found.causes[0].fit_without, found.fit_before, 1e-9);
}

TEST(Examine, NamesWrongTimesAndDampings) {
  const auto first = firstOrder();
  expectOnly(examined(*first, recordWithFactor(*first, 1, 1.3, {})), "sim_parameter", 0.13);
  const auto second = secondOrder();
  expectOnly(examined(*second, recordWithFactor(*second, 2, 1.4, {})), "sim_parameter", 0.56);
}

TEST(Examine, NamesParametersOfANonlinearSimulation) {
  PendulumSimulation pendulum;
  const OwnSimulationFindings mass = examined(pendulum, recordWithFactor(pendulum, 0, 1.15, {}));
  expectOnly(mass, "sim_parameter", 1.15);
  EXPECT_EQ(mass.causes[0].parameter, "mass");
  EXPECT_EQ(mass.causes[0].values[0].unit, "kg");
  const OwnSimulationFindings two =
      examined(pendulum, recordMachine(pendulum, Eigen::Vector3d(1.15, 0.55, 0.5), {}));
  ASSERT_EQ(two.causes.size(), 2u) << two.sentence;
  EXPECT_EQ(two.causes[0].parameter, "friction") << "what gains most comes first";
  EXPECT_GT(two.causes[1].fit_without, two.causes[0].fit_without);
  EXPECT_NEAR(two.causes[0].values[0].measured, 0.55, 3 * two.causes[0].values[0].standard_error);
  EXPECT_NEAR(two.causes[1].values[0].measured, 1.15, 3 * two.causes[1].values[0].standard_error);
}

TEST(Examine, NamesWhatIsDoneToTheOutput) {
  PendulumSimulation pendulum;
  MachineOptions options;
  options.output_change = [](const Eigen::VectorXd& y, int) {
    Eigen::VectorXd late = y;
    for (Eigen::Index k = 2; k < y.size(); ++k) late[k] = y[k - 2];
    return late;
  };
  expectOnly(examined(pendulum, recordWithFactor(pendulum, -1, 1, options)), "sim_delay", 0.04);
  options.output_change = [](const Eigen::VectorXd& y, int) {
    return Eigen::VectorXd((y.array() + 0.1).matrix());
  };
  expectOnly(examined(pendulum, recordWithFactor(pendulum, -1, 1, options)), "sim_offset", 0.1);
  options.output_change = [](const Eigen::VectorXd& y, int run) {
    Eigen::VectorXd with = y;
    for (Eigen::Index k = 0; k < y.size(); ++k)
      with[k] += 0.8 * std::cos(2.0 * run) * std::exp(-static_cast<double>(k) / 12);
    return with;
  };
  const OwnSimulationFindings start =
      examined(pendulum, recordWithFactor(pendulum, -1, 1, options));
  ASSERT_EQ(start.causes.size(), 1u) << start.sentence;
  EXPECT_EQ(start.causes[0].name, "sim_initial_state");
  EXPECT_NEAR(start.causes[0].values[0].measured, 0.24, 0.01);
  EXPECT_GT(start.fit_after, 96);
}

/// A dead zone makes the gain look smaller. With the curve before the simulation nothing is wrong.
TEST(Examine, TakesNoGainForADeadZone) {
  const auto simulation = firstOrder();
  MachineOptions options;
  options.input_curve = [](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    return u.unaryExpr([](double x) { return std::copysign(std::max(std::abs(x) - 0.5, 0.0), x); });
  };
  const OwnSimulationFindings found =
      examined(*simulation, recordWithFactor(*simulation, -1, 1, options), {});
  EXPECT_TRUE(found.has_curve_around);
  EXPECT_TRUE(found.causes.empty()) << found.sentence;
  ASSERT_EQ(found.structure.causes.size(), 1u) << found.sentence;
  EXPECT_EQ(found.structure.causes[0].what.name, "act_deadzone");
  EXPECT_GT(found.fit_after, 96) << "96.8 % is what the noise leaves";
  EXPECT_LT(found.fit_before, 80);
  const OwnSimulationFindings both =
      examined(*simulation, recordWithFactor(*simulation, 0, 1.2, options), {});
  ASSERT_EQ(both.causes.size(), 1u) << both.sentence;
  EXPECT_NEAR(both.causes[0].values.at(0).measured, 1.2, 0.02);
  EXPECT_NE(both.sentence.find("(act_deadzone); with this, and with gain "), std::string::npos)
      << both.sentence;
}

/// A curve of no natural slope is scaled with the simulation behind it, which then lacks nothing.
TEST(Examine, PutsAnyCurveOfTheInputInFront) {
  const auto simulation = firstOrder();
  MachineOptions options;
  options.input_curve = [](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    return u.unaryExpr([](double x) { return x > 0 ? x : 0.6 * x; });
  };
  const std::vector<Experiment> experiments = recordWithFactor(*simulation, -1, 1, options);
  const OwnSimulationFindings found = examined(*simulation, experiments, {});
  ASSERT_EQ(found.structure.causes.size(), 1u) << found.sentence;
  EXPECT_EQ(found.structure.causes[0].what.name, "act_asymmetry");
  EXPECT_TRUE(found.has_curve_around);
  EXPECT_GT(found.fit_after, 96) << "96.8 % is what the noise leaves";
  EXPECT_TRUE(found.causes.empty()) << found.sentence;
  const OwnSimulationFindings column = examinedAsColumn(*simulation, experiments, {});
  EXPECT_TRUE(column.has_curve_around) << "by a linear model of it: " << column.sentence;
  EXPECT_GT(column.fit_after, 96);
}

/// Of the first order, with a restoring force that grows with the cube.
class Hardening : public Simulation {
 public:
  std::string description() const override { return "the hardening plant"; }
  std::vector<SimulationParameter> parameters() const override { return {}; }
  bool canRerun() const override { return true; }
  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& /*values*/) override {
    constexpr int kSteps = 4;
    Eigen::VectorXd y(input.u.size());
    double x = 0;
    for (Eigen::Index k = 0; k < y.size(); ++k) {
      y[k] = x;
      for (int i = 0; i < kSteps; ++i)
        x += input.sample_time / kSteps * (input.u[k] - x - 0.3 * x * x * x) / 0.1;
    }
    return y;
  }
};

/// What a curve inside the plant does to the gain cannot be told: the curve comes first.
TEST(Examine, SaysThatValuesMayOnlyStandForACurve) {
  Hardening machine;
  const OwnSimulationFindings found =
      examined(*firstOrder(), recordMachine(machine, {}, MachineOptions()), {});
  ASSERT_FALSE(found.structure.causes.empty()) << found.sentence;
  EXPECT_EQ(found.structure.causes[0].what.name, "plant_cubic");
  EXPECT_TRUE(found.curveLeads());
  EXPECT_FALSE(found.has_curve_around);
  EXPECT_NE(found.sentence.find("which may only stand for it"), std::string::npos)
      << found.sentence;
}

TEST(Examine, NeverRunsMoreOftenThanItMay) {
  PendulumSimulation pendulum;
  const std::vector<Experiment> experiments =
      recordMachine(pendulum, Eigen::Vector3d(1.15, 0.55, 0.5), {});
  for (const int most : {20, 30, 100, 300, 700, 1500}) {
    ExamineOptions options = withoutStructure();
    options.max_simulations = most;
    const OwnSimulationFindings found = examined(pendulum, experiments, options);
    EXPECT_LE(found.simulations, most);
    EXPECT_TRUE(found.ended_early) << most;
    EXPECT_GE(found.fit_after, found.fit_before - 1e-9);
  }
  ExamineOptions options = withoutStructure();
  options.max_simulations = 19;
  EXPECT_NE(messageOf<ConfigurationError>([&] {
              examined(pendulum, experiments, options);
            }).find("simulation.max_simulations: found 19; allowed: at least 20"),
            std::string::npos);
}

TEST(Examine, TellsSignsAndUnits) {
  const auto simulation = firstOrder();
  const OwnSimulationFindings sign =
      examined(*simulation, recordWithFactor(*simulation, 0, -1, {}));
  expectOnly(sign, "sim_sign", -1);
  EXPECT_EQ(sign.causes[0].remark, "the opposite sign");
  const OwnSimulationFindings unit =
      examined(*simulation, recordWithFactor(*simulation, 0, 57.2958, {}));
  ASSERT_EQ(unit.causes.size(), 1u);
  EXPECT_EQ(unit.causes[0].remark, "looks like radians for degrees");
  EXPECT_EQ(likelyUnit(0.0174), "looks like degrees for radians");
  EXPECT_EQ(likelyUnit(1.3), "");
}

TEST(Examine, ALoggedOutputShowsTheParametersOfALinearModelOfIt) {
  const auto simulation = secondOrder();
  const OwnSimulationFindings found =
      examinedAsColumn(*simulation, recordWithFactor(*simulation, 2, 1.4, {}));
  expectOnly(found, "sim_damping", 0.56);
  EXPECT_NEAR(found.causes[0].values[0].yours, 0.4, 1e-3);
  EXPECT_GT(found.surrogate_fit, 99.9);
  EXPECT_FALSE(found.can_rerun);
  EXPECT_EQ(found.simulations, 0);
  const auto first = firstOrder();
  expectOnly(examinedAsColumn(*first, recordWithFactor(*first, 0, 1.1, {})), "sim_gain", 1.1);
}

/// The column is no covariate that acts on the machine.
TEST(Examine, ALoggedOutputIsNoInputOfTheMachine) {
  PendulumSimulation pendulum;
  const OwnSimulationFindings found =
      examinedAsColumn(pendulum, recordWithFactor(pendulum, 0, 1.15, {}), {});
  for (const SimulationCause& cause : found.structure.causes)
    EXPECT_NE(cause.what.name, "exp_input2") << found.sentence;
  EXPECT_FALSE(found.curveLeads()) << found.sentence;
  EXPECT_FALSE(found.causes.empty());
}

TEST(Examine, TellsWhatDiffersFromRunToRun) {
  const auto simulation = firstOrder();
  MachineOptions options;
  options.spread = 0.05;
  const OwnSimulationFindings found =
      examined(*simulation, recordWithFactor(*simulation, 0, 1.25, options));
  expectOnly(found, "sim_parameter", 1.25);
  EXPECT_NEAR(found.causes[0].values[0].run_spread, 1.25 * 0.05, 0.03);
  EXPECT_NE(found.sentence.find("from run to run"), std::string::npos) << found.sentence;
}

TEST(Examine, FindsNothingWrongWithAPerfectSimulation) {
  PendulumSimulation pendulum;
  const auto first = firstOrder(), second = secondOrder();
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    MachineOptions options;
    options.seed = seed;
    options.spread = seed % 2 == 0 ? 0.05 : 0;
    Simulation& simulation = seed % 3 == 0   ? static_cast<Simulation&>(pendulum)
                             : seed % 3 == 1 ? *first
                                             : *second;
    const OwnSimulationFindings found =
        examined(simulation, recordWithFactor(simulation, -1, 1, options));
    EXPECT_TRUE(found.causes.empty()) << seed << ": " << found.sentence;
    EXPECT_EQ(found.fit_after, found.fit_before);
  }
}

TEST(Examine, NamesACurveThatTheSimulationLacks) {
  PendulumSimulation pendulum;
  MachineOptions options;
  options.input_curve = [](const Eigen::VectorXd& u) {
    constexpr double kWidth = 0.6;
    return Eigen::VectorXd(
        (u.array() > kWidth)
            .select(u.array() - kWidth, (u.array() < -kWidth).select(u.array() + kWidth, 0.0)));
  };
  const OwnSimulationFindings found =
      examined(pendulum, recordWithFactor(pendulum, -1, 1, options), {});
  ASSERT_FALSE(found.structure.causes.empty()) << found.sentence;
  EXPECT_EQ(found.structure.causes[0].what.name, "act_deadzone") << found.sentence;
  EXPECT_NEAR(found.structure.causes[0].values.back().value, 0.6, 0.1);
  EXPECT_NE(found.sentence.find("It lacks a curve: "), std::string::npos) << found.sentence;
  options.input_curve = {};
  const OwnSimulationFindings none =
      examined(pendulum, recordWithFactor(pendulum, -1, 1, options), {});
  EXPECT_TRUE(none.structure.skipped.empty()) << none.structure.skipped;
  EXPECT_TRUE(none.structure.causes.empty()) << none.sentence;
}

TEST(Examine, OneLongRecordIsDividedAndItsEndHeldOut) {
  const auto simulation = firstOrder();
  MachineOptions options;
  options.experiments = 1;
  options.samples = 3000;
  const OwnSimulationFindings found =
      examine(*simulation, recordWithFactor(*simulation, 1, 1.3, options), {}, withoutStructure());
  expectOnly(found, "sim_parameter", 0.13);
  EXPECT_TRUE(found.held_out.empty());
  ASSERT_EQ(found.runs.size(), 1u);
  EXPECT_NEAR(found.runs[0].start, 2000 * options.sample_time, 1e-9);
  EXPECT_EQ(found.runs[0].measured.size(), 1000);
}

TEST(Examine, DrawsTheBestTheMedianAndTheWorstRun) {
  const auto simulation = firstOrder();
  const OwnSimulationFindings found =
      examined(*simulation, recordWithFactor(*simulation, 0, 1.1, {}));
  ASSERT_EQ(found.runs.size(), 3u);
  EXPECT_EQ(found.runs[0].rank + found.runs[1].rank + found.runs[2].rank, "bestmedianworst");
  for (const OwnRun& run : found.runs) {
    EXPECT_EQ(run.measured.size(), 300);
    EXPECT_LT((run.extended - 1.1 * run.yours).norm(), 0.01 * run.yours.norm());
    EXPECT_GT(run.fit_extended, run.fit_yours);
  }
}

TEST(Examine, EndsWhereNoFurtherRunIsAllowed) {
  PendulumSimulation pendulum;
  ExamineOptions options;
  options.max_simulations = 60;
  const OwnSimulationFindings found =
      examined(pendulum, recordWithFactor(pendulum, 0, 1.15, {}), options);
  EXPECT_TRUE(found.ended_early);
  EXPECT_LE(found.simulations, 80);
  EXPECT_NE(found.sentence.find("before the search ended"), std::string::npos) << found.sentence;
}

TEST(Examine, RefusesDataWithNothingToCompare) {
  const auto simulation = firstOrder();
  std::vector<Experiment> experiments = recordWithFactor(*simulation, 0, 1, {});
  for (Experiment& each : experiments) each.y.setConstant(3);
  EXPECT_NE(messageOf<DataError>([&] {
              examine(*simulation, experiments, {}, {});
            }).find("whose output is not constant"),
            std::string::npos);
}

}  // namespace
}  // namespace uncertainty_identification
