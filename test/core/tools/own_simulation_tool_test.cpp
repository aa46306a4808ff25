// explain with a simulation of the user, in each of the ways in which it can be given.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "support/own_machine.h"
#include "support/process.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/io/csv.h"
#include "uncertainty_identification/io/explanation_json.h"

namespace uncertainty_identification {
namespace {

const std::string kProgram = std::string(PROJECT_FOLDER) + "/examples/pendulum_simulation.py";

/// A pendulum that is heavier than its simulation, whose output was logged as y_sim.
class OwnSimulationTool : public testing::Test {
 protected:
  OwnSimulationTool() {
    PendulumSimulation pendulum;
    MachineOptions options;
    options.samples = 150;
    std::vector<Experiment> experiments = recordWithFactor(pendulum, 0, 1.15, options);
    for (Experiment& each : experiments)
      each.signals["y_sim"] = pendulum.run(inputOf(each), Eigen::Vector3d(1, 0.4, 0.5));
    writeCsv(folder_ / "runs.csv", experiments);
  }

  ProcessResult explain(const std::string& simulation) {
    std::ofstream(folder_ / "c.yaml")
        << "nominal_model: {na: 2, nb: 2}\nerror_model: {taps: 0}\nbounds: {frequencies: 0}\n"
           "explanation: {max_causes: 2, time_limit: 3}\n"
        << simulation;
    return runProcess({std::string(TOOLS_FOLDER) + "/explain", "--config", folder_ / "c.yaml",
                       "--output", explanation_, folder_ / "runs.csv"});
  }

  static bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  TemporaryFolder folder_;
  const std::string explanation_ = folder_ / "explanation.json";
};

TEST_F(OwnSimulationTool, NamesTheParameterOfAProgram) {
  const ProcessResult run = explain("simulation: {command: [" + kProgram +
                                    "], parameters: {mass: {value: 1, unit: kg}, friction: {value: "
                                    "0.4}, length: {value: 0.5, unit: m}}}\n");
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_EQ(run.output.rfind("Your simulation fits ", 0), 0u) << run.output;
  EXPECT_TRUE(says(run.output, "; with mass 1")) << run.output;
  EXPECT_TRUE(says(run.output, "Verdict: ")) << run.output;
  const Explanation explanation = loadExplanation(explanation_);
  ASSERT_TRUE(explanation.own_simulation.has_value());
  const OwnSimulationFindings& found = *explanation.own_simulation;
  ASSERT_EQ(found.causes.size(), 1u) << found.sentence;
  EXPECT_EQ(found.causes[0].parameter, "mass");
  EXPECT_NEAR(found.causes[0].values[0].measured, 1.15, 0.01);
  EXPECT_EQ(found.held_out, explanation.held_out) << "both are measured on the same runs";
}

TEST_F(OwnSimulationTool, ALoggedColumnIsNoCovariate) {
  const ProcessResult run = explain("simulation: {column: y_sim}\n");
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_TRUE(says(run.output, "This is the column y_sim")) << run.output;
  EXPECT_FALSE(says(run.output, "[y_sim]")) << run.output;
  const Explanation explanation = loadExplanation(explanation_);
  EXPECT_FALSE(explanation.own_simulation->causes.empty());
  const ProcessResult missing = explain("simulation: {column: y_simulated}\n");
  EXPECT_EQ(missing.status, 1);
  EXPECT_TRUE(says(missing.errors, "explain: the column y_simulated: an experiment does not hold"))
      << missing.errors;
}

TEST_F(OwnSimulationTool, WhatFailsIsToldAndNothingIsWritten) {
  const ProcessResult crash =
      explain("simulation: {command: [sh, -c, 'echo broken >&2; exit 3']}\n");
  EXPECT_EQ(crash.status, 1);
  EXPECT_TRUE(says(crash.errors, "the program sh: it ended before it answered")) << crash.errors;
  EXPECT_TRUE(says(crash.errors, "broken")) << crash.errors;
  const ProcessResult absent = explain("simulation: {command: [./no_such_simulation]}\n");
  EXPECT_EQ(absent.status, 2);
  EXPECT_TRUE(says(absent.errors, "cannot start './no_such_simulation'")) << absent.errors;
  EXPECT_FALSE(std::filesystem::exists(explanation_));
}

}  // namespace
}  // namespace uncertainty_identification
