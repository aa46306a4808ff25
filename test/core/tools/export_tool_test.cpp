// The tool export as a shell meets it.
#include <gtest/gtest.h>

#include <filesystem>

#include "io/read_file.h"
#include "support/export_setup.h"
#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

using test::mentions;

class Export : public testing::Test {
 protected:
  Export() { saveResult(model_, test::delayedResult()); }

  ProcessResult run(const std::string& target, const std::string& output,
                    const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{std::string(TOOLS_FOLDER) + "/export",
                                     "--model",
                                     model_,
                                     "--to",
                                     target,
                                     "--output",
                                     output};
    command.insert(command.end(), more.begin(), more.end());
    return runProcess(command);
  }

  void expectRefusal(const ProcessResult& result, const std::string& part, int status = 2) const {
    EXPECT_EQ(result.status, status);
    EXPECT_EQ(result.output, "");
    EXPECT_EQ(result.errors.rfind("export: ", 0), 0u) << result.errors;
    EXPECT_TRUE(mentions(result.errors, part)) << result.errors;
  }

  const TemporaryFolder folder_;
  const std::string model_ = folder_ / "result.json";
};

TEST_F(Export, WritesEveryTarget) {
  const std::vector<std::array<std::string, 3>> targets{
      {"mat", "motor.mat", "MATLAB 5.0 MAT-file"},
      {"python", "motor.py", "\"\"\"Model motor: "},
      {"octave", "motor.m", "function [model, systems] = motor("},
      {"rosparam", "motor.yaml", "# motor: rosparam load FILE /motor"},
      {"c", "motor.c", "/* motor: simulator and whitening filter, C99."}};
  for (const auto& [target, name, begins] : targets) {
    const ProcessResult result = run(target, folder_ / name);
    EXPECT_EQ(result.status, 0) << result.errors;
    EXPECT_EQ(result.output.rfind("Model 'motor' written to ", 0), 0u) << result.output;
    EXPECT_EQ(mentions(result.output, "20 plants drawn (seed 1)"),
              target != "rosparam" && target != "c")
        << result.output;
    EXPECT_EQ(readFile(folder_ / name).rfind(begins, 0), 0u) << name;
  }
}

TEST_F(Export, TheSameSeedGivesTheSameFile) {
  ASSERT_EQ(run("python", folder_ / "a.py", {"--seed", "7", "--count", "3"}).status, 0);
  const std::string first = readFile(folder_ / "a.py");
  EXPECT_TRUE(mentions(first, "samples_seed = 7.0"));
  ASSERT_EQ(run("python", folder_ / "a.py", {"--seed", "7", "--count", "3"}).status, 0);
  EXPECT_EQ(readFile(folder_ / "a.py"), first);
  ASSERT_EQ(run("python", folder_ / "a.py", {"--seed", "8", "--count", "3"}).status, 0);
  EXPECT_NE(readFile(folder_ / "a.py"), first);
}

TEST_F(Export, SaysWhatTheResultDoesNotHold) {
  saveResult(model_, test::bareResult());
  const ProcessResult result = run("c", folder_ / "motor.c");
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(mentions(result.output, "Not exported: bands and weight: the result holds no bounds"))
      << result.output;
}

TEST_F(Export, RefusesWhatItCannotDo) {
  const std::string output = folder_ / "motor.m";
  expectRefusal(run("fmu", output), "--to: found 'fmu'; allowed: mat, python, octave, rosparam, c");
  expectRefusal(run("mat", output, {"--count", "0"}), "--count: found 0; allowed: 1 to 1000");
  expectRefusal(run("mat", output, {"--seed", "9007199254740993"}), "--seed: found 900719925474");
  expectRefusal(run("octave", folder_ / "my-motor.m"), "begins with a letter, as in my_motor.m");
  expectRefusal(run("mat", folder_ / "nowhere/motor.mat"), "there is no folder");
  expectRefusal(
      runProcess({std::string(TOOLS_FOLDER) + "/export", "--model", model_, "--output", output}),
      "'--to' is required");
  EXPECT_FALSE(std::filesystem::exists(output));
}

TEST_F(Export, RefusesResultsThatHoldNoModel) {
  saveResult(model_, Result());
  expectRefusal(run("c", folder_ / "motor.c"), "the result holds no model", 1);
  std::ofstream(model_) << "{\"format\": 1}";
  expectRefusal(run("c", folder_ / "motor.c"), "format");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "motor.c"));
}

TEST_F(Export, ReplacesNoInput) {
  const std::string before = readFile(model_);
  expectRefusal(run("rosparam", model_), "is to be written and is also read");
  EXPECT_EQ(readFile(model_), before);
}

}  // namespace
}  // namespace uncertainty_identification
