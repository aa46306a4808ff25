#include "io/inspection_yaml.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "inspection/suggestion.h"
#include "io/csv_survey.h"
#include "support/error_message.h"
#include "support/mentions.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/configuration_yaml.h"
#include "uncertainty_identification/io/csv.h"

namespace uncertainty_identification {
namespace {

/// As a cell of a .csv file.
std::string quotedCell(const std::string& name) {
  std::string cell = "\"";
  for (const char c : name) cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + "\"";
}

/// Three signals that move, of which the first two are input and output.
InspectedData inspectedColumns(const std::string& input, const std::string& output) {
  InspectedData data;
  data.survey.records = 1;
  data.survey.times = {{"t", "s", false, ""}};
  for (const std::string& name : {input, output, std::string("third")}) {
    Channel channel;
    channel.name = channel.column = name;
    channel.records = {{{0, 1, 2, 3}, {1, 5, 2, 8}}};
    data.survey.channels.push_back(channel);
    data.measures.push_back(measure(channel));
  }
  data.choice.chosen = SignalPair{0, 1, {}, 1};
  data.configuration = suggestedConfiguration(data.survey, data.choice, {});
  data.loaded.experiments.resize(1);
  return data;
}

class InspectionYamlFile : public testing::Test {
 protected:
  Configuration written(const InspectedData& data) {
    std::ofstream(folder_ / "c.yaml") << inspectionYaml(data);
    return loadConfiguration(folder_ / "c.yaml");
  }

  void expectReadBack(const InspectedData& data) {
    EXPECT_EQ(toJson(written(data)), toJson(data.configuration)) << inspectionYaml(data);
  }

  const TemporaryFolder folder_;
};

constexpr const char* kOddNames[] = {"a: b",
                                     "- a",
                                     "[a]",
                                     "{a: 1}",
                                     "a, b",
                                     "#1",
                                     "a # b",
                                     "it's",
                                     "\"a\"",
                                     "a\\n",
                                     " leading",
                                     "tail ",
                                     "null",
                                     "true",
                                     "0x10",
                                     "1e3",
                                     "~",
                                     "*a",
                                     "&a",
                                     "!a",
                                     "%a",
                                     "@a",
                                     "|",
                                     ">",
                                     "?",
                                     "<<",
                                     "${a}",
                                     "\xC3\xBC \xC2\xB0/s",
                                     "\xF0\x9F\x98\x80"};

TEST_F(InspectionYamlFile, KeepsAnyNameOfAColumn) {
  for (const std::string name : kOddNames) {
    InspectedData data = inspectedColumns(name, name + "2");
    data.survey.times = {{name + "3", "ms", false, name + "4"}};
    data.configuration = suggestedConfiguration(data.survey, data.choice, {});
    const Configuration read = written(data);
    EXPECT_EQ(read.input.column, name);
    EXPECT_EQ(read.output.column, name + "2");
    EXPECT_EQ(read.time.column, name + "3");
    EXPECT_EQ(read.time.unit, TimeUnit::milliseconds);
    EXPECT_EQ(read.experiment.column, name + "4");
  }
}

TEST_F(InspectionYamlFile, ReadsTheFileThatWasSurveyed) {
  const std::string input = "cmd: \"left\", [V]", output = " speed #1 {rad/s}";
  std::ofstream file(folder_ / "log.csv");
  file << "time_ms," << quotedCell("note, free") << "," << quotedCell(input) << ","
       << quotedCell(output) << "\n";
  for (int k = 0; k < 60; ++k)
    file << 20 * k << "," << k % 4 << "," << (k / 5) % 3 << "," << std::sin(0.2 * k) << "\n";
  file.close();
  InspectedData data;
  data.survey = surveyCsv(folder_ / "log.csv", {});
  for (const Channel& channel : data.survey.channels) data.measures.push_back(measure(channel));
  data.choice = chooseSignals(data.survey, data.measures);
  data.configuration = suggestedConfiguration(data.survey, data.choice, {});
  data.loaded = readCsv(folder_ / "log.csv", data.configuration);
  const LoadedData read = readCsv(folder_ / "log.csv", written(data));
  ASSERT_EQ(read.experiments.size(), 1u);
  const Experiment& experiment = read.experiments.front();
  ASSERT_EQ(experiment.samples(), 60);
  EXPECT_NEAR(experiment.sample_time, 0.02, 1e-9);
  for (int k = 0; k < 60; ++k) {
    EXPECT_EQ(experiment.u[k], (k / 5) % 3);
    EXPECT_NEAR(experiment.y[k], std::sin(0.2 * k), 1e-5);
  }
}

TEST_F(InspectionYamlFile, OffersFurtherSignalsThatWorkWhenSwitchedOn) {
  InspectedData data = inspectedColumns("cmd", "speed");
  data.survey.channels[2].name = data.survey.channels[2].column = "temp: \"x\" [C]";
  std::string text = inspectionYaml(data);
  EXPECT_TRUE(parseConfiguration(YAML::Load(text)).covariates.empty());
  for (const std::string start : {"# covariates:", "#   - {name"}) {
    const auto at = text.find("\n" + start);
    ASSERT_NE(at, std::string::npos) << text;
    text.erase(at + 1, start.front() == '#' && start[2] == 'c' ? 2 : 1);
  }
  const Configuration read = parseConfiguration(YAML::Load(text));
  ASSERT_EQ(read.covariates.size(), 1u) << text;
  EXPECT_EQ(read.covariates[0].name, "temp: \"x\" [C]");
  EXPECT_EQ(read.covariates[0].column, "temp: \"x\" [C]");
}

TEST_F(InspectionYamlFile, OffersNoSignalThatCannotBeACovariate) {
  InspectedData data = inspectedColumns("cmd", "speed");
  data.survey.channels[2].column = "Temp \xB0";
  EXPECT_FALSE(test::mentions(inspectionYaml(data), "covariates")) << "no YAML can name it";
  data = inspectedColumns("cmd", "speed");
  data.measures[2].shape = SignalShape::constant;
  EXPECT_FALSE(test::mentions(inspectionYaml(data), "covariates"));
  data = inspectedColumns("u", "y");
  EXPECT_FALSE(test::mentions(inspectionYaml(data), "covariates"))
      << "beside u and y every column already is one";
}

TEST_F(InspectionYamlFile, LeavesUAndYToTheReader) {
  const InspectedData data = inspectedColumns("u", "y");
  EXPECT_TRUE(test::mentions(inspectionYaml(data), "# input: {}   # the column u\n"));
  EXPECT_TRUE(test::mentions(inspectionYaml(data), "# output: {}   # the column y\n"));
  expectReadBack(data);
}

TEST_F(InspectionYamlFile, KeepsNumbersToTheLastBit) {
  InspectedData data = inspectedColumns("cmd", "speed");
  data.configuration.input.scale = M_PI / 180;
  data.configuration.input.offset = -1.0 / 3;
  data.configuration.output.scale = 1e-300;
  data.configuration.experiment.mode = ExperimentMode::duration;
  data.configuration.experiment.duration = 0.1 + 0.2;
  expectReadBack(data);
}

TEST_F(InspectionYamlFile, CountsRowsWithASampleTimeToFillIn) {
  InspectedData data = inspectedColumns("cmd", "speed");
  data.survey.times = {{"", "index", false, ""}};
  data.configuration = suggestedConfiguration(data.survey, data.choice, {});
  EXPECT_TRUE(test::mentions(inspectionYaml(data), "write the real sample time [s] here"));
  expectReadBack(data);
}

TEST_F(InspectionYamlFile, StatesNoTimeWhereFilesDiffer) {
  InspectedData data = inspectedColumns("cmd", "speed");
  data.survey.times.push_back({"time_ms", "ms", false, ""});
  data.configuration = suggestedConfiguration(data.survey, data.choice, {});
  EXPECT_FALSE(test::mentions(inspectionYaml(data), "\ntime:"));
  expectReadBack(data);
}

TEST_F(InspectionYamlFile, OfWholeExperimentsNamesTheirTopicOnly) {
  InspectedData data = inspectedColumns("cmd", "speed");
  data.choice = {};
  data.configuration = {};
  data.configuration.experiment.mode = ExperimentMode::message;
  data.configuration.experiment.topic = "/node: experiments";
  EXPECT_FALSE(test::mentions(inspectionYaml(data), "input:"));
  expectReadBack(data);
}

TEST_F(InspectionYamlFile, KeepsCommentsToTheirLines) {
  InspectedData data = inspectedColumns("cmd", "speed");
  data.choice.doubt = "it could be 'a\nsample_time: 7'";
  data.survey.times.front().experiments = "run\nsample_time: 8";
  EXPECT_EQ(written(data).sample_time, 0);
}

TEST_F(InspectionYamlFile, RefusesANameThatIsNoText) {
  for (const std::string name : {"Temp \xB0", "a\nb", "a\tb"}) {
    const InspectedData data = inspectedColumns("cmd", name);
    EXPECT_TRUE(test::mentions(messageOf<DataError>([&] { inspectionYaml(data); }),
                               "holds bytes that are no text"));
  }
}

}  // namespace
}  // namespace uncertainty_identification
