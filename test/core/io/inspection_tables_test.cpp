#include "io/inspection_tables.h"

#include <gtest/gtest.h>

#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

using test::mentions;

SurveyedStream regularStream(const std::string& file, const std::string& name,
                             const std::string& type) {
  SurveyedStream stream{file, name, type, {}, {"u", "y"}, ""};
  stream.stamps.count = 11;
  stream.stamps.end = 20;
  stream.stamps.period = 2;
  stream.stamps.uniform = true;
  return stream;
}

/// Channels named c0, c1, ... with these measures.
std::string tableOf(std::size_t count, const SignalMeasures& measures) {
  Survey survey;
  survey.channels.resize(count);
  for (std::size_t i = 0; i < count; ++i) survey.channels[i].name = "c" + std::to_string(i);
  return signalTable(survey, std::vector<SignalMeasures>(count, measures));
}

TEST(StreamTables, ListTheTopicsOfEachBagAndThenFiles) {
  Survey survey;
  survey.streams = {regularStream("/logs/a.bag", "/cmd", "std_msgs/Float64"),
                    regularStream("/logs/a.bag", "/odom", "nav_msgs/Odometry"),
                    regularStream("/logs/b.bag", "/cmd", "std_msgs/Float64"),
                    regularStream("/logs/c.csv", "c", "")};
  survey.streams[1].remark = "two publishers\x1b[31m";
  const std::string text = streamTables(survey);
  const auto a = text.find("Topics of /logs/a.bag"), b = text.find("Topics of /logs/b.bag"),
             files = text.find("Files of columns");
  EXPECT_EQ(text.find("Topics of /logs/a.bag", a + 1), std::string::npos) << "one table a bag";
  EXPECT_LT(a, text.find("nav_msgs/Odometry"));
  EXPECT_LT(text.find("nav_msgs/Odometry"), b);
  EXPECT_LT(b, files);
  EXPECT_LT(files, text.find("c.csv"));
  EXPECT_TRUE(mentions(text, "  /odom: two publishers\\x1B[31m\n"));
}

TEST(StreamTables, SayColumnsOnceAndNameExperimentsOfAFile) {
  Survey survey;
  survey.streams = {regularStream("/logs/a.csv", "a", ""),
                    regularStream("/logs/b.csv", "run 7", "")};
  survey.times = {{"", "index", false, ""}};
  const std::string text = streamTables(survey);
  for (const char* part : {"Files of columns (no column of time)", "u, y", "the same",
                           "b.csv, run 7", "every 2 s", "20 s", "regular"})
    EXPECT_TRUE(mentions(text, part)) << part << "\n" << text;
  EXPECT_FALSE(mentions(text, "a.csv, a"));
  survey.streams[1].fields = {"u", "z"};
  EXPECT_FALSE(mentions(streamTables(survey), "the same"));
}

TEST(StreamTables, SayWhatIsOddAboutStamps) {
  Survey survey;
  survey.streams = {regularStream("a.csv", "a", "")};
  StampSummary& stamps = survey.streams.front().stamps;
  stamps.jitter = 0.03;
  EXPECT_TRUE(mentions(streamTables(survey), "regular")) << "too little to be told";
  stamps.uniform = false;
  stamps.pauses = 1;
  stamps.longest_pause = 60;
  stamps.backward = 3;
  EXPECT_TRUE(mentions(streamTables(survey), "irregular, 1 pause of 60 s, 3 stamps go back"));
}

TEST(StreamTables, CountFilesBeyondTheThirtieth) {
  Survey survey;
  for (int k = 0; k < 33; ++k) {
    const std::string name = "run" + std::to_string(k);
    survey.streams.push_back(regularStream(name + ".csv", name, ""));
  }
  survey.streams.back().remark = "line 9 is broken";
  const std::string text = streamTables(survey);
  EXPECT_TRUE(mentions(text, "run29.csv"));
  EXPECT_FALSE(mentions(text, "run30.csv"));
  EXPECT_TRUE(mentions(text, "and 3 more"));
  EXPECT_TRUE(mentions(text, "line 9 is broken")) << "a remark is never left out";
}

TEST(SignalTable, GathersSignalsThatSayNothing) {
  SignalMeasures measures;
  EXPECT_TRUE(mentions(tableOf(2, measures), "without a value: c0, c1\n"));
  measures.samples = 5;
  measures.smallest = measures.largest = -2.5;
  EXPECT_TRUE(mentions(tableOf(10, measures), "constant (10): c0 = -2.5, c1 = -2.5"));
  EXPECT_TRUE(mentions(tableOf(10, measures), "c7 = -2.5 and 2 more\n"));
}

TEST(SignalTable, ShowsWhatWasMeasured) {
  SignalMeasures measures;
  measures.samples = 1000;
  measures.smallest = -1;
  measures.largest = 1;
  measures.resolution = 0.25;
  measures.held = 0.0002;
  measures.at_smallest = 0.4;
  measures.clipped = true;
  measures.shape = SignalShape::continuous;
  measures.band = 12.5;
  const std::string text = tableOf(1, measures);
  for (const char* part : {"-1 to 1", "0.25", "<0.1 %", "moves continuously", "below 12.5 Hz",
                           "stays at its smallest value for 40 % of the samples"})
    EXPECT_TRUE(mentions(text, part)) << part << "\n" << text;
  measures.shape = SignalShape::two_levels;
  EXPECT_TRUE(mentions(tableOf(1, measures), "switches between -1 and 1"));
}

TEST(ExperimentTable, CountsSamplesAndMissingOutputs) {
  LoadedData data;
  EXPECT_EQ(experimentTable(data), "");
  Experiment experiment;
  experiment.id = "first";
  experiment.sample_time = 0.02;
  experiment.u = experiment.y = Eigen::VectorXd::Zero(150);
  experiment.valid.assign(150, 1);
  experiment.valid[7] = experiment.valid[8] = 0;
  data.experiments.assign(32, experiment);
  const std::string text = experimentTable(data);
  const std::string row = text.substr(
      text.find("first"), text.find("first", text.find("first") + 1) - text.find("first"));
  for (const char* part : {" 150 ", " 0.02 s", " 3 s", " 2"})
    EXPECT_TRUE(mentions(row, part)) << part << "\n" << row;
  EXPECT_TRUE(mentions(text, "and 2 more"));
}

}  // namespace
}  // namespace uncertainty_identification
