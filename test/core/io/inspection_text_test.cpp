#include "io/inspection_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/inspection_html.h"
#include "io/inspection_tables.h"
#include "io/inspection_yaml.h"
#include "support/error_message.h"
#include "support/mentions.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/configuration_yaml.h"

namespace uncertainty_identification {
namespace {

using test::mentions;

Channel movingChannel(const std::string& name) {
  Channel channel;
  channel.name = channel.column = name;
  channel.records.resize(1);
  for (int k = 0; k < 100; ++k) {
    channel.records.front().stamps.push_back(0.1 * k);
    channel.records.front().values.push_back(k % 7 + 0.01 * k);
  }
  return channel;
}

Experiment cutExperiment(const std::string& id) {
  Experiment experiment;
  experiment.id = id;
  experiment.sample_time = 0.1;
  experiment.u = Eigen::VectorXd::LinSpaced(50, 0, 1);
  experiment.y = Eigen::VectorXd::LinSpaced(50, 1, 0);
  return experiment;
}

/// A file with the columns cmd and "wheel speed", cut into two experiments.
InspectedData inspectedMotor() {
  InspectedData data;
  data.survey.records = 1;
  data.survey.times = {{"t", "s", true, ""}};
  data.survey.channels = {movingChannel("cmd"), movingChannel("wheel speed")};
  data.survey.streams.push_back({"/logs/motor.csv", "motor", "", {}, {"cmd", "wheel speed"}, ""});
  data.survey.streams.front().stamps = summaryOf(data.survey.channels[0].records[0].stamps);
  for (const Channel& channel : data.survey.channels) data.measures.push_back(measure(channel));
  data.choice.chosen = SignalPair{0, 1, {true, 0.8, 0.2, 0.02, 0.1, 0.05, 0.1}, 4};
  data.choice.input_reason = "its name says 'cmd'";
  data.choice.output_reason = "its name says 'speed'";
  data.configuration.input.column = "cmd";
  data.configuration.output.column = "wheel speed";
  data.configuration.time.column = "t";
  data.loaded.experiments = {cutExperiment("motor_000"), cutExperiment("motor_001")};
  return data;
}

/// Sentences about how the signals follow each other.
std::string sentencesWith(const Following& following) {
  InspectedData data = inspectedMotor();
  data.choice.chosen->following = following;
  std::string all;
  for (const std::string& sentence : choiceSentences(data)) all += sentence + "\n";
  return all;
}

TEST(InspectionText, SaysWhatFollowsWhat) {
  EXPECT_TRUE(mentions(sentencesWith({true, 0.8, 0.2, 0.02, 0.1, 0.05, 0.1}),
                       "'wheel speed' follows 'cmd' after about 0.2 s (correlation 0.80"));
  EXPECT_TRUE(
      mentions(sentencesWith({true, 0.8, 0, 0.02, 0.1, 0.05, 0.1}), "within one reading of 0.1 s"));
  EXPECT_TRUE(mentions(sentencesWith({true, 0.04, 0.2, 0.02, 0.1, 0.05, 0.1}), "It is not seen"));
  EXPECT_TRUE(mentions(sentencesWith({}), "cannot be told: too few samples"));
}

TEST(InspectionText, SaysWhatSpeaksForALoop) {
  EXPECT_TRUE(mentions(sentencesWith({true, 0.8, 0.2, 0.02, 0.1, 0.05, 0.1}),
                       "Closed loop: no sign that 'cmd' follows 'wheel speed'"));
  EXPECT_TRUE(mentions(sentencesWith({true, 0.5, 0.2, 0.4, 0.1, 0.05, 0.1}),
                       "Closed loop: perhaps, as 'cmd' follows 'wheel speed' after about 0.1 s"));
  EXPECT_TRUE(mentions(sentencesWith({true, 0.2, 0.2, 0.4, 0.1, 0.05, 0.1}),
                       "input and output may be exchanged"));
  EXPECT_TRUE(
      mentions(sentencesWith({true, 0.5, 0.2, 0.2, 0.1, 0.05, 0.1}), "no sign that 'cmd' follows"))
      << "less than half as much as the other way round";
  EXPECT_TRUE(
      mentions(sentencesWith({true, 0.8, 0, 0.02, 0.1, 0.05, 0.1}), "Closed loop: cannot be seen"));
}

TEST(InspectionText, TellsADoubtAndOtherPairs) {
  InspectedData data = inspectedMotor();
  data.choice.doubt = "the input could be any of 'cmd', 'duty'";
  data.choice.others = {{1, 0, {true, 0.7, 0.1, 0, 0.1, 0.05, 0.1}, 2}};
  const std::string text = inspectionText(data);
  EXPECT_TRUE(mentions(text, "Cannot tell for sure: the input could be any of 'cmd', 'duty'"));
  EXPECT_TRUE(mentions(text, "'wheel speed' to 'cmd' (follows, correlation 0.70)"));
  data.choice = {};
  data.choice.doubt = "no two signals move";
  EXPECT_TRUE(mentions(inspectionText(data), "Cannot tell: no two signals move."));
}

TEST(InspectionText, TellsWhereRowsAreCountedForTime) {
  InspectedData data = inspectedMotor();
  EXPECT_FALSE(mentions(chosenText(data), "a row is taken for"));
  data.configuration.time.unit = TimeUnit::index;
  data.configuration.time.sample_time = 1;
  EXPECT_TRUE(mentions(chosenText(data), "a row is taken for 1 s"));
}

TEST(InspectionText, SaysNotesOfOneKindOnce) {
  InspectedData data = inspectedMotor();
  for (int k = 0; k < 5; ++k)
    data.loaded.warnings.push_back("experiment 'motor_00" + std::to_string(k) + "': 1" +
                                   std::to_string(k) + " rows are missing");
  data.loaded.rejected = {{"motor_002", "experiment 'motor_002': the input is constant"}};
  const std::string text = inspectionText(data);
  EXPECT_TRUE(mentions(text, "note: experiment 'motor_000': 10 rows are missing (and 4 more"));
  EXPECT_FALSE(mentions(text, "11 rows"));
  EXPECT_TRUE(mentions(text, "left out: experiment 'motor_002': the input is constant"));
}

TEST(InspectionTables, ShowStampsAndRemarks) {
  InspectedData data = inspectedMotor();
  StampSummary& stamps = data.survey.streams.front().stamps;
  stamps.pauses = 2;
  stamps.longest_pause = 3;
  stamps.repeated = 4;
  stamps.jitter = 0.01;
  data.survey.streams.front().remark = "line 7 is broken";
  const std::string text = streamTables(data.survey);
  for (const char* part :
       {"motor.csv", "100", "10 Hz", "9.9 s", "jitter up to 10 ms", "2 pauses, up to 3 s",
        "4 stamps repeat", "line 7 is broken", "time: column 't' in s, assumed"})
    EXPECT_TRUE(mentions(text, part)) << part << "\n" << text;
}

TEST(InspectionTables, ShowSignals) {
  InspectedData data = inspectedMotor();
  data.survey.channels[0].unit = "V";
  data.survey.channels[0].empty = 3;
  data.measures[0].clipped = true;
  data.measures[0].at_largest = 0.25;
  data.measures[1].shape = SignalShape::constant;
  const std::string text = signalTable(data.survey, data.measures);
  for (const char* part : {"cmd", "V", "0 to 6.97", "stays at its largest value for 25 %",
                           "3 values missing", "constant (1): wheel speed = "})
    EXPECT_TRUE(mentions(text, part)) << part << "\n" << text;
}

TEST(InspectionYaml, IsAConfigurationThatSaysWhatWasFound) {
  InspectedData data = inspectedMotor();
  data.survey.channels.push_back(movingChannel("temp \"x\""));
  data.measures.push_back(measure(data.survey.channels.back()));
  const std::string text = inspectionYaml(data);
  const Configuration read = parseConfiguration(YAML::Load(text));
  EXPECT_EQ(toJson(read), toJson(data.configuration)) << text;
  EXPECT_TRUE(mentions(text, "# Input u: 'cmd' (its name says 'cmd')."));
  EXPECT_TRUE(mentions(text, "taken for seconds; otherwise ms, us, ns, min, h or d"));
  EXPECT_TRUE(mentions(text, "#   - {name: \"temp \\\"x\\\"\", column: \"temp \\\"x\\\"\"}"));
}

TEST(InspectionYaml, HoldsTopicsCutsAndScales) {
  InspectedData data = inspectedMotor();
  data.survey.times.clear();
  for (Channel& channel : data.survey.channels) channel.column.clear();
  Configuration& configuration = data.configuration;
  configuration = {};
  configuration.input.topic = "/cmd";
  configuration.input.field = "effort[0]";
  configuration.input.scale = 0.1;
  configuration.output.topic = "/odom";
  configuration.output.field = "twist.linear.x";
  configuration.output.offset = -2;
  configuration.experiment.mode = ExperimentMode::gap;
  configuration.experiment.gap = 1.5;
  EXPECT_EQ(toJson(parseConfiguration(YAML::Load(inspectionYaml(data)))), toJson(configuration));
  configuration.experiment = {};
  configuration.experiment.topic = "/run";
  EXPECT_EQ(toJson(parseConfiguration(YAML::Load(inspectionYaml(data)))), toJson(configuration));
}

TEST(InspectionYaml, IsNotWrittenWhereItWouldNotWork) {
  InspectedData data = inspectedMotor();
  data.loaded.experiments.clear();
  data.loaded.rejected = {{"motor", "the input is constant"}};
  EXPECT_TRUE(mentions(messageOf<DataError>([&] { inspectionYaml(data); }),
                       "no experiment can be used:\nthe input is constant"));
  data = inspectedMotor();
  data.failure = "a column is missing";
  EXPECT_TRUE(mentions(messageOf<DataError>([&] { inspectionYaml(data); }), "a column is missing"));
  data = inspectedMotor();
  data.choice = {};
  data.choice.doubt = "no two signals move";
  EXPECT_TRUE(mentions(messageOf<DataError>([&] { inspectionYaml(data); }), "no two signals move"));
}

TEST(InspectionHtml, DrawsEachExperimentAndWhereItWasCut) {
  const std::string page = inspectionHtml(inspectedMotor());
  EXPECT_TRUE(mentions(page, "<h3>motor_001, 5 s</h3>"));
  EXPECT_TRUE(mentions(page, "<h2>Where the record is cut</h2>"));
  EXPECT_TRUE(mentions(page, "<text x=\"4\" y=\"12\">wheel speed: 0 to 6.97</text>"));
  InspectedData several = inspectedMotor();
  several.survey.records = 2;
  EXPECT_FALSE(mentions(inspectionHtml(several), "Where the record is cut"));
}

}  // namespace
}  // namespace uncertainty_identification
