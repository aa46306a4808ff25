// inspect as a stranger meets it, and the tools that run without a configuration.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "io/read_file.h"
#include "io/truth_yaml.h"
#include "ros/bag_writer.h"
#include "simulation/simulate.h"
#include "support/mentions.h"
#include "support/process.h"
#include "support/temporary_folder.h"

namespace uncertainty_identification {
namespace {

ProcessResult runTool(const std::string& name, const std::vector<std::string>& arguments) {
  std::vector<std::string> command{std::string(TOOLS_FOLDER) + "/" + name};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return runProcess(command);
}

/// What a logger of a motor writes: semicolons, milliseconds, names of its own.
std::string motorLog(const std::string& input, const std::string& output, int samples = 400) {
  std::ostringstream file;
  file << "time_ms;" << input << ";" << output << ";mode\n";
  std::mt19937 random(4);
  double u = 0, y = 0;
  for (int k = 0; k < samples; ++k) {
    if (k % 9 == 0) u = random() % 2 == 0 ? 12 : 3;
    file << 10 * k << ";" << u << ";" << y << ";auto\n";
    y = 0.9 * y + 0.4 * u + 1e-3 * static_cast<double>(random() % 100);
  }
  return file.str();
}

class Inspect : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }

  const TemporaryFolder folder_;
};

using test::mentions;

TEST_F(Inspect, ShowsWhatIsInAFileAndWritesAConfigurationThatWorks) {
  const std::string data = write("log.csv", motorLog("motor_voltage", "wheel_speed"));
  const std::string config = folder_ / "c.yaml";
  const ProcessResult shown = runTool("inspect", {"--write", config, data});
  ASSERT_EQ(shown.status, 0) << shown.errors;
  for (const char* part :
       {"time: column 'time_ms' in ms", "log.csv", "100 Hz", "switches between 3 and 12",
        "Input u: 'motor_voltage' (its name says 'voltage'", "Output y: 'wheel_speed'",
        "follows 'motor_voltage' after about 0.01 s", "no sign that 'motor_voltage' follows",
        "columns of text, passed over: 'mode'", "400      0.01 s"})
    EXPECT_TRUE(mentions(shown.output, part)) << part << "\n" << shown.output;
  const std::string written = readFile(config);
  EXPECT_TRUE(mentions(written, "\ninput: {column: \"motor_voltage\"}\n")) << written;
  EXPECT_TRUE(mentions(written, "\ntime: {column: \"time_ms\", unit: ms}\n")) << written;
  for (const char* tool : {"identify", "explain"}) {
    const ProcessResult used =
        runTool(tool, {"--config", config, "--output", folder_ / "out.json", data});
    EXPECT_EQ(used.status, 0) << tool << ": " << used.errors;
  }
}

TEST_F(Inspect, IdentifyTakesUnambiguousNamesByItself) {
  const std::string data = write("log.csv", motorLog("motor_voltage", "wheel_speed"));
  const ProcessResult result = runTool("identify", {"--output", folder_ / "out.json", data});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(mentions(result.errors, "identify: input: 'motor_voltage' (its name says 'voltage'"))
      << result.errors;
  EXPECT_TRUE(mentions(result.errors, "output: 'wheel_speed'")) << result.errors;
}

TEST_F(Inspect, IdentifyAndExplainAskWhereNamesLeaveADoubt) {
  const std::string data = write("log.csv", motorLog("a", "b"));
  for (const char* tool : {"identify", "explain"}) {
    const ProcessResult result = runTool(tool, {"--output", folder_ / "out.json", data});
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(mentions(result.errors, "no signal that moves is called like an input"))
        << result.errors;
    EXPECT_TRUE(mentions(result.errors, "inspect --write C.yaml DATA...")) << result.errors;
  }
  const std::string config = folder_ / "c.yaml";
  const ProcessResult shown = runTool("inspect", {"--write", config, data});
  ASSERT_EQ(shown.status, 0) << shown.errors;
  EXPECT_TRUE(mentions(shown.output, "Cannot tell for sure")) << shown.output;
  EXPECT_TRUE(mentions(readFile(config), "input: {column: \"a\"}")) << readFile(config);
}

TEST_F(Inspect, PlainColumnsNeedNoWords) {
  std::string log = motorLog("u", "y");
  log.replace(0, 7, "t");
  const std::string data = write("log.csv", log);
  const ProcessResult result = runTool("identify", {"--output", folder_ / "out.json", data});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_FALSE(mentions(result.errors, "input:")) << result.errors;
}

TEST_F(Inspect, ShowsTheConfiguredSignals) {
  const std::string data = write("log.csv", motorLog("a", "b"));
  const std::string config =
      write("given.yaml",
            "{input: {column: a, scale: 2}, output: {column: b}, experiment: {mode: duration, "
            "duration: 1}}");
  const std::string copy = folder_ / "copy.yaml";
  const ProcessResult shown = runTool("inspect", {"--config", config, "--write", copy, data});
  ASSERT_EQ(shown.status, 0) << shown.errors;
  EXPECT_TRUE(mentions(shown.output, "Input u: 'a' (the configuration says so)"));
  EXPECT_TRUE(mentions(shown.output, "log_003")) << shown.output;
  EXPECT_TRUE(mentions(readFile(copy), "input: {column: \"a\", scale: 2.0}")) << readFile(copy);
  EXPECT_TRUE(mentions(readFile(copy), "experiment: {mode: duration, duration: 1.0}"));
}

TEST_F(Inspect, DrawsAPageThatNeedsNoOtherFile) {
  const std::string data = write("log.csv", motorLog("motor_voltage", "w<i>"));
  const std::string config =
      write("c.yaml",
            "{input: {column: motor_voltage}, output: {column: w<i>}, experiment: {mode: duration, "
            "duration: 1}}");
  const ProcessResult shown =
      runTool("inspect", {"--config", config, "--html", folder_ / "page.html", data});
  ASSERT_EQ(shown.status, 0) << shown.errors;
  const std::string page = readFile(folder_ / "page.html");
  EXPECT_TRUE(mentions(page, "Input u: 'motor_voltage'"));
  EXPECT_TRUE(mentions(page, "w&lt;i>")) << "names are no HTML";
  EXPECT_FALSE(mentions(page, "w<i>"));
  EXPECT_FALSE(mentions(page, "http"));
  std::size_t cuts = 0, pictures = 0;
  for (std::size_t at = page.find("<rect"); at != std::string::npos;
       at = page.find("<rect", at + 1))
    ++cuts;
  for (std::size_t at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1))
    ++pictures;
  EXPECT_EQ(cuts, 4u);
  EXPECT_EQ(pictures, 5u) << "the record, and four experiments";
}

TEST_F(Inspect, ReplacesNoInputAndWritesNothingThatWouldNotWork) {
  const std::string data = write("log.csv", motorLog("motor_voltage", "wheel_speed"));
  const std::string before = readFile(data);
  EXPECT_EQ(runTool("inspect", {"--write", data, data}).status, 2);
  EXPECT_EQ(runTool("inspect", {"--write", data, folder_.path()}).status, 2);
  EXPECT_EQ(readFile(data), before);
  const std::string both = folder_ / "both.html";
  const ProcessResult twice = runTool("inspect", {"--write", both, "--html", both, data});
  EXPECT_EQ(twice.status, 2);
  EXPECT_TRUE(mentions(twice.errors, "is named for two outputs")) << twice.errors;
  EXPECT_FALSE(std::filesystem::exists(both));
  const std::string tabs = write("tabs.tsv", before);
  EXPECT_EQ(runTool("inspect", {"--html", tabs, folder_.path()}).status, 2);
  EXPECT_EQ(readFile(tabs), before);
  std::filesystem::remove(tabs);
  const std::string still = write("still.csv", "t,u,y\n0,1,2\n1,1,2\n2,1,2\n");
  const ProcessResult refused = runTool("inspect", {"--write", folder_ / "c.yaml", still});
  EXPECT_EQ(refused.status, 1);
  EXPECT_TRUE(mentions(refused.errors, "no configuration was written")) << refused.errors;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "c.yaml"));
  EXPECT_EQ(runTool("inspect", {}).status, 2);
  EXPECT_EQ(runTool("inspect", {folder_ / "absent.csv"}).status, 2);
}

TEST_F(Inspect, TellsOfAFileThatCannotBeReadBesideOthers) {
  write("a.csv", motorLog("motor_voltage", "wheel_speed"));
  write("b.csv", "");
  const ProcessResult shown = runTool("inspect", {folder_.path()});
  EXPECT_EQ(shown.status, 0) << shown.errors;
  EXPECT_TRUE(mentions(shown.output, "the file is empty")) << shown.output;
}

TEST_F(Inspect, EscapesNamesThatAreNoText) {
  const std::string data = write("log.csv", motorLog("motor_voltage \xB0\x1b[31m", "speed"));
  const ProcessResult shown = runTool("inspect", {"--write", folder_ / "c.yaml", data});
  EXPECT_EQ(shown.status, 1);
  EXPECT_TRUE(mentions(shown.output, "motor_voltage \\xB0\\x1B[31m")) << shown.output;
  EXPECT_TRUE(mentions(shown.errors, "save the file in UTF-8")) << shown.errors;
}

/// Files that were damaged at random places end in an answer or a message, and never half-way.
TEST_F(Inspect, SurvivesMutatedFiles) {
  const std::string original = motorLog("motor_voltage", "wheel_speed", 60);
  std::mt19937 random(20);
  const std::string bytes =
      ";,\t\n\r\"0-9e.NaN\0\xFF#%="
      "t";
  for (int trial = 0; trial < 200; ++trial) {
    std::string content = original;
    for (unsigned change = 0; change <= random() % 20; ++change) {
      const std::size_t at = random() % content.size();
      const std::size_t most = trial % 2 == 0 ? 40 : content.size();  // the header, or anywhere
      const char byte = bytes[random() % bytes.size()];
      if (random() % 3 == 0)
        content.erase(at % most, 1 + random() % 30);
      else if (random() % 2 == 0)
        content.insert(at % most, 1, byte);
      else
        content[at % most] = byte;
      if (content.empty()) content = "t";
    }
    const std::string data = write("mutated.csv", content), config = folder_ / "c.yaml";
    std::filesystem::remove(config);
    const ProcessResult shown = runTool("inspect", {"--write", config, data});
    EXPECT_TRUE(shown.status >= 0 && shown.status <= 2) << shown.status << "\n" << content;
    EXPECT_EQ(shown.errors.empty(), shown.status == 0) << shown.errors << content;
    EXPECT_FALSE(mentions(shown.errors, "internal error")) << shown.errors << content;
    EXPECT_EQ(std::filesystem::exists(config), shown.status == 0) << content;
  }
}

/// The same for bags, of which bytes are changed or the end is missing.
TEST_F(Inspect, SurvivesMutatedBags) {
  Truth truth = loadTruth(std::string(PROJECT_FOLDER) + "/config/example1_truth.yaml");
  truth.experiments = 3;
  writeBag(folder_ / "whole.bag", simulate(truth, 1));
  ASSERT_EQ(runTool("inspect", {folder_ / "whole.bag"}).status, 0);
  const std::string original = readFile(folder_ / "whole.bag");
  std::mt19937 random(21);
  int refused = 0;
  for (int trial = 0; trial < 60; ++trial) {
    std::string content = original;
    for (unsigned change = 0; change <= random() % 30; ++change)
      content[random() % content.size()] = static_cast<char>(random() % 256);
    if (trial % 4 == 0) content.resize(random() % content.size());
    const ProcessResult shown = runTool("inspect", {write("mutated.bag", content)});
    EXPECT_TRUE(shown.status == 0 || shown.status == 2) << shown.status << shown.errors;
    EXPECT_EQ(shown.errors.empty(), shown.status == 0) << shown.errors;
    EXPECT_FALSE(mentions(shown.errors, "internal error")) << shown.errors;
    refused += shown.status == 2 ? 1 : 0;
  }
  EXPECT_GT(refused, 15) << "a bag without its end has no index";
}

TEST_F(Inspect, NoToolFollowsAnAliasThatHoldsItself) {
  const std::string data = write("log.csv", motorLog("u", "y"));
  const std::string config = write("c.yaml", "input: &a [*a, *a]\n");
  const std::string output = folder_ / "out.csv";
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"identify", "--config", config, "--output", output, data},
        {"explain", "--config", config, "--output", output, data},
        {"inspect", "--config", config, "--write", output, data},
        {"simulate", "--config", config, "--output", output}}) {
    const ProcessResult result = runTool(command.front(), {command.begin() + 1, command.end()});
    EXPECT_EQ(result.status, 2) << command.front() << ": " << result.errors;
    EXPECT_TRUE(mentions(result.errors, "line 1: aliases (*name) are refused")) << result.errors;
  }
}

}  // namespace
}  // namespace uncertainty_identification
