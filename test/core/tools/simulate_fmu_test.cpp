// FMUs in a process of their own: what goes wrong in them ends with a message, and with nothing
// left behind.
#include <gtest/gtest.h>

#include <filesystem>

#include "fmu/unpacked_fmu.h"
#include "io/open_simulation.h"
#include "support/error_message.h"
#include "support/fmu_builder.h"
#include "support/process.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;

class SimulateFmu : public testing::Test {
 protected:
  void SetUp() override {
    if (!readsFmus()) GTEST_SKIP() << "built without libzip or tinyxml2";
  }

  std::unique_ptr<Simulation> motorWith(const std::vector<std::string>& defines) {
    test::FmuRecipe recipe;
    recipe.defines = defines;
    test::buildFmu(options_.fmu, recipe);
    options_.input = "voltage";
    options_.output = "speed";
    options_.parameters["friction"] = {};
    options_.parameters["inertia"].value = 0.03;
    return openSimulation(options_, 0.01);
  }

  static Eigen::VectorXd runOf(Simulation& motor) {
    SimulationInput input;
    input.sample_time = 0.01;
    input.u = Eigen::VectorXd::Ones(20);
    return motor.run(input, Eigen::Vector2d(0.15, 0.03));
  }

  void expectComplaint(int fault, const std::string& part) {
    const auto motor = motorWith({"FAULT=" + std::to_string(fault)});
    const std::string message = messageOf<DataError>([&] { runOf(*motor); });
    EXPECT_EQ(message.find("the FMU " + options_.fmu + ": "), 0u) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }

  static std::size_t unpackedFolders() {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(fs::temp_directory_path()))
      count += entry.path().filename().string().rfind("uncertainty_identification_fmu_", 0) == 0;
    return count;
  }

  const TemporaryFolder folder_;
  OwnSimulationOptions options_ = [this] {
    OwnSimulationOptions options;
    options.fmu = folder_ / "motor.fmu";
    return options;
  }();
};

TEST_F(SimulateFmu, HasTheParametersOfTheFmuAndOfTheConfiguration) {
  const std::size_t before = unpackedFolders();
  {
    const auto motor = motorWith({});
    ASSERT_EQ(motor->parameters().size(), 2u);
    EXPECT_EQ(motor->parameters()[0].name, "friction");
    EXPECT_EQ(motor->parameters()[0].value, 0.15) << "that of the FMU";
    EXPECT_EQ(motor->parameters()[0].unit, "N m");
    EXPECT_EQ(motor->parameters()[1].value, 0.03) << "that of the configuration";
    EXPECT_GT(runOf(*motor)[19], 1);
    EXPECT_EQ(unpackedFolders(), before + 1);
  }
  EXPECT_EQ(unpackedFolders(), before);
}

TEST_F(SimulateFmu, ACrashEndsWithAMessage) { expectComplaint(1, "ended by signal 6 (Aborted)"); }

TEST_F(SimulateFmu, WhatHangsIsEnded) {
  options_.time_limit = 1;
  expectComplaint(2, "it gave no answer within 1 s");
}

TEST_F(SimulateFmu, WhatAllocatesWithoutEndIsEnded) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer's own memory would count";
#endif
  options_.memory_limit = 200;
  expectComplaint(4, "(simulation.memory_limit is 200 MB)");
}

TEST_F(SimulateFmu, AnErrorIsToldWithTheFunction) { expectComplaint(5, "fmi2DoStep failed"); }

TEST_F(SimulateFmu, NanIsNoFailureOfTheProgram) {
  const auto motor = motorWith({"FAULT=3"});
  EXPECT_FALSE(runOf(*motor).allFinite());
}

TEST_F(SimulateFmu, WhatItPrintsIsNoAnswer) {
  const auto motor = motorWith({"FAULT=6"});
  EXPECT_EQ(runOf(*motor).size(), 20);
}

TEST_F(SimulateFmu, WrongNamesAreRefusedBeforeItRuns) {
  motorWith({});
  options_.input = "torque";
  EXPECT_EQ(messageOf<ConfigurationError>([&] { openSimulation(options_, 0.01); }),
            "simulation.input: found 'torque'; allowed, by the FMU's modelDescription.xml: "
            "voltage");
}

TEST_F(SimulateFmu, TheProgramRefusesWhatIsNoParameter) {
  motorWith({});
  const ProcessResult run =
      runProcess({std::string(TOOLS_FOLDER) + "/simulate_fmu", "--fmu", options_.fmu, "--input",
                  "voltage", "--output", "speed", "--parameter", "inertia"});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.errors.find("--parameter: found 'inertia'; allowed: NAME=NUMBER"),
            std::string::npos)
      << run.errors;
}

}  // namespace
}  // namespace uncertainty_identification
