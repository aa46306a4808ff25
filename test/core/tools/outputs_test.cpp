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
  expectRefusal("report", {model}, model);
  expectRefusal("simulate", {"--config", truth}, truth);
}

}  // namespace
}  // namespace uncertainty_identification
