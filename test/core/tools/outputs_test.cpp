// No tool replaces what it reads.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "io/read_file.h"
#include "support/plain_estimate.h"
#include "support/process.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {
namespace {

class Outputs : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name) << content;
    return folder_ / name;
  }

  /// The tool refuses and leaves the file as it was.
  void expectRefusal(const std::string& name, const std::vector<std::string>& arguments,
                     const std::string& output) const {
    std::vector<std::string> command{std::string(TOOLS_FOLDER) + "/" + name, "--output", output};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const std::string before = readFile(output);
    const ProcessResult result = runProcess(command);
    EXPECT_EQ(result.status, 2) << name << ": " << result.errors;
    EXPECT_NE(result.errors.find(output + ": is to be written and is also read"), std::string::npos)
        << result.errors;
    EXPECT_EQ(readFile(output), before) << name;
  }

  const TemporaryFolder folder_;
  const std::string config_ = std::string(PROJECT_FOLDER) + "/config/";
};

TEST_F(Outputs, AreNoneOfTheInputs) {
  const std::string data = write("data.csv", "t,u,y\n0,1,2\n0.1,1,2\n");
  const std::string config = write("config.yaml", readFile(config_ + "example1.yaml"));
  const std::string truth = write("truth.csv", readFile(config_ + "example1_truth.yaml"));
  const std::string model = folder_ / "result.json";
  saveResult(model,
             {test::plainEstimate(Eigen::Vector2d(1, 0.5), Eigen::Vector2d(-0.5, 0.1)), {}, {}});
  for (const char* name : {"identify", "explain"}) {
    expectRefusal(name, {"--config", config, data}, data);
    expectRefusal(name, {"--config", config, folder_.path()}, data);
    expectRefusal(name, {"--config", config, "--validation", data, data}, data);
    expectRefusal(name, {"--config", config, data}, config);
  }
  expectRefusal("sample", {"--model", model, "--count", "1"}, model);
  expectRefusal("export", {"--model", model, "--to", "c"}, model);
  expectRefusal("report", {model}, model);
  expectRefusal("simulate", {"--config", truth}, truth);
}

/// Both files are of one layout, which is one remark.
TEST_F(Outputs, RepeatNoRemarkOnDataForTheValidation) {
  std::string rows = "time_ms,u,y\n";
  for (int t = 0; t < 200; ++t)
    rows += std::to_string(10 * t) + "," + std::to_string(t * t % 7) + "," +
            std::to_string((t + 1) * (t + 1) % 11) + "\n";
  const std::string data = write("data.csv", rows), validation = write("validation.csv", rows);
  const std::string config =
      write("config.yaml", "{estimation: {algorithm: em}, nominal_model: {na: 1, nb: 1}}");
  const ProcessResult run =
      runProcess({std::string(TOOLS_FOLDER) + "/identify", "--config", config, "--output",
                  folder_ / "result.json", "--validation", validation, "--", data});
  ASSERT_EQ(run.status, 0) << run.errors;
  const std::size_t first = run.output.find("'time_ms' in ms");
  ASSERT_NE(first, std::string::npos) << run.output;
  EXPECT_EQ(run.output.find("'time_ms' in ms", first + 1), std::string::npos) << run.output;
}

/// Two loggers, of which one wrote every third sample.
TEST_F(Outputs, ExperimentsOfTwoRatesAreUsedTogether) {
  const auto rows = [](double sample_time, int samples) {
    std::string text = "t,u,y\n";
    double y = 0;
    for (int t = 0; t < samples; ++t) {
      const double u = t / 12 % 3 - 1 + 0.5 * (t / 7 % 2);
      text += std::to_string(sample_time * t) + "," + std::to_string(u) + "," + std::to_string(y) +
              "\n";
      y += sample_time * (u - y) / 2;
    }
    return text;
  };
  const std::string fast = write("fast.csv", rows(0.1, 900)),
                    slow = write("slow.csv", rows(0.3, 300));
  const std::string result = folder_ / "result.json";
  const ProcessResult run = runProcess({std::string(TOOLS_FOLDER) + "/identify", "--config",
                                        write("config.yaml", "{nominal_model: {na: 1, nb: 1}}"),
                                        "--output", result, "--validation", slow, "--", fast});
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_NE(run.output.find("they were resampled to 0.3 s"), std::string::npos) << run.output;
  EXPECT_NEAR(loadResult(result).estimate.nominal_model.sample_time, 0.3, 1e-9);
}

}  // namespace
}  // namespace uncertainty_identification
