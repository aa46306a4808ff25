// What --write-extended writes is run: its own check must give the fits that explain reported.
#include "export/extended_simulation.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "io/open_simulation.h"
#include "own_simulation/examine.h"
#include "support/error_message.h"
#include "support/own_machine.h"
#include "support/process.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

const std::string kProgram = std::string(PROJECT_FOLDER) + "/examples/pendulum_simulation.py";

class ExtendedSimulation : public testing::Test {
 protected:
  /// Examines a simulation with the last four experiments held out, and writes what is found.
  OwnSimulationFindings written(const OwnSimulationOptions& options,
                                std::vector<Experiment> experiments, bool structure,
                                std::size_t held_out = 4) {
    const auto simulation = openSimulation(options, experiments[0].sample_time);
    const std::vector<Experiment> all = experiments;
    const std::vector<Experiment> held(all.end() - static_cast<std::ptrdiff_t>(held_out),
                                       all.end());
    experiments.resize(all.size() - held_out);
    ExamineOptions how;
    how.structure = structure;
    const OwnSimulationFindings found = examine(*simulation, experiments, held, how);
    writeExtendedSimulation(out_, options, found, held.empty() ? all : held);
    return found;
  }

  /// Both programs agree with the report.
  void expectAgreement(const OwnSimulationFindings& found) {
    const std::string python = out_ + "/extended_simulation.py";
    const std::string program = out_ + "/extended_simulation";
    const ProcessResult check = runProcess({"/usr/bin/env", "python3", python, "--check"});
    EXPECT_EQ(check.status, 0) << found.sentence << "\n" << check.output << check.errors;
    const ProcessResult compiled =
        runProcess({"/usr/bin/env", "c++", "-std=c++17", "-Wall", "-Wextra", "-Werror",
                    program + ".cpp", "-o", program});
    ASSERT_EQ(compiled.status, 0) << compiled.errors;
    const ProcessResult same =
        runProcess({"/usr/bin/env", "-C", out_, "./extended_simulation", "--check"});
    EXPECT_EQ(same.status, 0) << same.output << same.errors;
    EXPECT_EQ(same.output, check.output);
    EXPECT_NE(check.output.find("agrees\nextended: fit "), std::string::npos) << check.output;
  }

  static MachineOptions machine() {
    MachineOptions options;
    options.experiments = 14;
    options.samples = 200;
    return options;
  }

  static OwnSimulationOptions pendulumProgram() {
    OwnSimulationOptions options;
    options.command = {kProgram};
    options.parameters = {{"mass", {1, "kg"}}, {"friction", {0.4, ""}}, {"length", {0.5, "m"}}};
    return options;
  }

  static OwnSimulationOptions secondOrder() {
    OwnSimulationOptions options;
    options.has_model = true;
    options.model.physical = {{"gain", 2.0}, {"omega1", 8.0}, {"zeta1", 0.4}};
    return options;
  }

  static std::unique_ptr<Simulation> opened(const OwnSimulationOptions& options) {
    return openSimulation(options, machine().sample_time);
  }

  const TemporaryFolder folder_;
  const std::string out_ = folder_ / "extended";
};

TEST_F(ExtendedSimulation, OfAProgramHasItsParameters) {
  PendulumSimulation pendulum;
  const OwnSimulationFindings found =
      written(pendulumProgram(), recordWithFactor(pendulum, 0, 1.15, machine()), false);
  ASSERT_EQ(found.extension.parameters.size(), 3u);
  expectAgreement(found);
  const nlohmann::json json =
      extendedSimulationJson(pendulumProgram(), found, folder_ / "working folder");
  EXPECT_EQ(json["kind"], "program");
  EXPECT_EQ(json["folder"], folder_ / "working folder");
  for (const auto& each : json["parameters"]) {
    EXPECT_EQ(each["name"] == "mass", each["yours"] != each["measured"]) << each;
    if (each["name"] == "mass") {
      EXPECT_EQ(each["yours"], 1);
      EXPECT_NEAR(each["measured"].get<double>(), 1.15, 0.01);
      EXPECT_EQ(each["unit"], "kg");
      EXPECT_LT(each["lower_95"], each["upper_95"]);
    }
  }
}

TEST_F(ExtendedSimulation, IsASimulationThatIsRightItself) {
  PendulumSimulation pendulum;
  const std::vector<Experiment> experiments = recordWithFactor(pendulum, 0, 1.15, machine());
  written(pendulumProgram(), experiments, false);
  OwnSimulationOptions extended;
  extended.command = {"python3", out_ + "/extended_simulation.py"};
  const auto simulation = openSimulation(extended, machine().sample_time);
  const Eigen::VectorXd y = simulation->run(inputOf(experiments[0]), Eigen::VectorXd());
  EXPECT_LT((y - experiments[0].y).norm(), 0.1 * experiments[0].y.norm());
}

TEST_F(ExtendedSimulation, HasWhatStandsBehindTheSimulation) {
  MachineOptions options = machine();
  options.output_change = [](const Eigen::VectorXd& y, int run) {
    Eigen::VectorXd changed = Eigen::VectorXd::Constant(y.size(), 0.4);
    for (Eigen::Index k = 3; k < y.size(); ++k) changed[k] += 1.3 * y[k - 3];
    for (Eigen::Index k = 0; k < y.size(); ++k)
      changed[k] += (run % 2 == 0 ? 1 : -1) * std::exp(-static_cast<double>(k) / 16.0);
    return changed;
  };
  const auto simulation = opened(secondOrder());
  const OwnSimulationFindings found =
      written(secondOrder(), recordWithFactor(*simulation, -1, 1, options), false);
  EXPECT_NEAR(found.extension.offset, 0.4, 0.05) << found.sentence;
  EXPECT_GT(found.extension.delay + found.extension.transient, 0) << found.sentence;
  expectAgreement(found);
}

TEST_F(ExtendedSimulation, HasACurveInFront) {
  MachineOptions options = machine();
  options.input_curve = [](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    return (u.array().abs() - 0.6).max(0) * u.array().sign();
  };
  const auto simulation = opened(secondOrder());
  const OwnSimulationFindings found =
      written(secondOrder(), recordWithFactor(*simulation, 0, 1.2, options), true);
  ASSERT_TRUE(found.extension.curve.has_value()) << found.sentence;
  EXPECT_EQ(found.extension.curve->of, "input");
  expectAgreement(found);
}

TEST_F(ExtendedSimulation, HasACurveBehind) {
  MachineOptions options = machine();
  options.output_change = [](const Eigen::VectorXd& y, int) -> Eigen::VectorXd {
    return y.array() + 0.05 * y.array().cube();
  };
  const auto simulation = opened(secondOrder());
  const OwnSimulationFindings found =
      written(secondOrder(), recordWithFactor(*simulation, -1, 1, options), true);
  ASSERT_TRUE(found.extension.curve.has_value()) << found.sentence;
  EXPECT_EQ(found.extension.curve->of, "output");
  EXPECT_GT(found.fit_after, 95);
  expectAgreement(found);
}

TEST_F(ExtendedSimulation, OfALoggedSignalTakesWhatALinearModelOfItSays) {
  PendulumSimulation pendulum;
  std::vector<Experiment> experiments = recordWithFactor(pendulum, 0, 1.15, machine());
  for (Experiment& each : experiments)
    each.signals["y_sim"] = pendulum.run(inputOf(each), Eigen::Vector3d(1, 0.4, 0.5));
  OwnSimulationOptions options;
  options.column = "y_sim";
  const OwnSimulationFindings found = written(options, experiments, false);
  EXPECT_TRUE(found.extension.yours.has_value());
  EXPECT_TRUE(found.extension.parameters.empty());
  expectAgreement(found);
}

TEST_F(ExtendedSimulation, ComparesThePartsOfFewExperimentsThatWereHeldOut) {
  MachineOptions options = machine();
  options.experiments = 2;
  std::vector<Experiment> experiments = recordWithFactor(*opened(secondOrder()), 0, 1.3, options);
  experiments[0].valid.assign(200, 1);
  experiments[0].valid[150] = 0;
  experiments[0].y[150] = 1e6;
  expectAgreement(written(secondOrder(), experiments, false, 0));
}

TEST_F(ExtendedSimulation, DiffersWhereItIsChanged) {
  written(secondOrder(), recordWithFactor(*opened(secondOrder()), 0, 1.3, machine()), false);
  const std::string path = out_ + "/extended_simulation.py";
  std::ifstream in(path);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  const std::string gain = "\"gain\": 1.0";
  ASSERT_NE(text.find(gain), std::string::npos);
  std::ofstream(path) << text.replace(text.find(gain), gain.size(), "\"gain\": 1.5");
  const ProcessResult check = runProcess({"/usr/bin/env", "python3", path, "--check"});
  EXPECT_EQ(check.status, 1);
  EXPECT_NE(check.output.find("extended: fit "), std::string::npos) << check.errors;
  EXPECT_NE(check.output.find("DIFFERS"), std::string::npos) << check.output;
}

TEST_F(ExtendedSimulation, ReplacesNothingThatIsRead) {
  Configuration configuration;
  const auto refusal = [&](const std::vector<std::string>& inputs, const std::string& output) {
    return messageOf<Error>([&] { requireExtendedWritable(out_, configuration, inputs, output); });
  };
  EXPECT_EQ(refusal({}, folder_ / "e.json").find("--write-extended: the configuration gives no"),
            0u);
  configuration.simulation = pendulumProgram();
  EXPECT_EQ(refusal({}, folder_ / "e.json"), "no exception");
  std::filesystem::create_directory(out_);
  std::ofstream(out_ + "/held_out.csv") << "t,u,y\n";
  EXPECT_NE(refusal({out_ + "/held_out.csv"}, folder_ / "e.json").find("is also read"),
            std::string::npos);
  EXPECT_NE(refusal({}, out_ + "/extended_simulation.json").find("named for two outputs"),
            std::string::npos);
  configuration.simulation->command = {"python3", out_ + "/extended_simulation.py"};
  EXPECT_NE(refusal({}, folder_ / "e.json").find("is also read"), std::string::npos);
}

}  // namespace
}  // namespace uncertainty_identification
