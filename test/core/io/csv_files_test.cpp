#include <gtest/gtest.h>

#include <fstream>

#include "support/error_message.h"
#include "support/mentions.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/csv.h"

// How files of other programs become experiments; csv_dialect_table_test.cpp tests how they are
// read.
namespace uncertainty_identification {
namespace {

using test::anyMentions;

LoadedData readText(const std::string& content, const Configuration& configuration = {}) {
  const TemporaryFolder folder;
  std::ofstream(folder / "log.csv") << content;
  return readCsv(folder / "log.csv", configuration);
}

/// Rows t,u,y with t = step k, u = k, y = 10 k for k = first..last, each with `more` at its end.
std::string sampleRows(int first, int last, double step, const std::string& more = "") {
  std::ostringstream text;
  for (int k = first; k <= last; ++k) text << step * k << "," << k << "," << 10 * k << more << "\n";
  return text.str();
}

std::vector<std::string> idsOf(const LoadedData& data) {
  std::vector<std::string> found;
  for (const Experiment& experiment : data.experiments) found.push_back(experiment.id);
  return found;
}

std::vector<int> lengthsOf(const LoadedData& data) {
  std::vector<int> found;
  for (const Experiment& experiment : data.experiments) found.push_back(experiment.samples());
  return found;
}

using Ids = std::vector<std::string>;
using Lengths = std::vector<int>;

Configuration dividedBy(ExperimentMode mode, double seconds = 0) {
  Configuration configuration;
  configuration.experiment.mode = mode;
  configuration.experiment.duration = configuration.experiment.gap = seconds;
  return configuration;
}

TEST(CsvFiles, DurationCutsAsInBags) {
  const LoadedData data =
      readText("t,u,y\n" + sampleRows(0, 99, 0.5), dividedBy(ExperimentMode::duration, 20));
  EXPECT_EQ(idsOf(data), (Ids{"log_000", "log_001", "log_002"}));
  EXPECT_EQ(lengthsOf(data), (Lengths{40, 40, 20}));
  EXPECT_EQ(data.experiments.at(1).y(0), 400);
  EXPECT_EQ(data.experiments.at(1).sample_time, 0.5);
}

/// A reading that failed: the rows are used as they are otherwise.
TEST(CsvFiles, FalseReadingsAreReplacedAndTold) {
  const LoadedData data = readText("t,u,y\n" + sampleRows(0, 49, 0.5) +
                                   "25,-9.9e37,500\n25.5,51,1e30\n" + sampleRows(52, 99, 0.5));
  ASSERT_EQ(data.experiments.size(), 1u);
  const Experiment& experiment = data.experiments.front();
  EXPECT_EQ(experiment.u(50), 49);
  EXPECT_EQ(experiment.y(50), 500);
  EXPECT_EQ(experiment.u(51), 51);
  EXPECT_FALSE(experiment.isValid(51));
  EXPECT_TRUE(anyMentions(data.warnings, "experiment 'log': 2 single readings lie far beyond"));
  EXPECT_TRUE(anyMentions(data.warnings, "input -9.9e+37 at 25 s, output 1e+30 at 25.5 s"));
}

TEST(CsvFiles, SlowLogsHaveTheirTimeInHours) {
  Configuration configuration;
  configuration.time.column = "t";
  configuration.time.unit = TimeUnit::hours;
  EXPECT_EQ(
      readText("t,u,y\n" + sampleRows(0, 29, 0.25), configuration).experiments.at(0).sample_time,
      900);
  EXPECT_EQ(readText("t [min],u,y\n" + sampleRows(0, 29, 0.25)).experiments.at(0).sample_time, 15);
}

TEST(CsvFiles, GapCutsAsInBags) {
  const std::string content = "t,u,y\n" + sampleRows(0, 29, 0.5) + sampleRows(34, 69, 0.5);
  EXPECT_EQ(lengthsOf(readText(content, dividedBy(ExperimentMode::gap, 2))), (Lengths{30, 36}));
  EXPECT_EQ(lengthsOf(readText(content, dividedBy(ExperimentMode::gap, 3))), (Lengths{70}));
}

TEST(CsvFiles, AColumnWithTheNameOfTheTopicMarksExperiments) {
  const std::string content = sampleRows(0, 9, 0.5, ",0") + sampleRows(10, 39, 0.5, ",1") +
                              sampleRows(40, 49, 0.5, ",") + sampleRows(50, 54, 0.5, ",False") +
                              sampleRows(55, 79, 0.5, ",true");
  for (const std::string name : {"/experiment/active/data", "experiment/active"}) {
    const LoadedData data = readText("t,u,y," + name + "\n" + content);
    EXPECT_EQ(lengthsOf(data), (Lengths{40, 25})) << name;
    EXPECT_EQ(data.experiments.at(0).u(0), 10);
    EXPECT_TRUE(anyMentions(data.warnings, "marked by '" + name + "'"));
  }
  const LoadedData never = readText("t,u,y,experiment/active\n" + sampleRows(0, 30, 0.5, ",0"));
  EXPECT_TRUE(never.experiments.empty());
  EXPECT_TRUE(test::mentions(never.rejected.at(0).reason, "log.csv holds no experiment"));
  Configuration other;
  other.experiment.topic = "running";
  EXPECT_TRUE(anyMentions(readText("t,u,y\n" + sampleRows(0, 30, 0.5), other).warnings,
                          "no column marks experiments (experiment.topic: running)"));
}

/// A file that was kept by a node is read with the node's configuration.
TEST(CsvFiles, AreTakenAsAWholeWhereServicesOrMessagesDivide) {
  for (const ExperimentMode mode : {ExperimentMode::service, ExperimentMode::message}) {
    const Configuration whole = dividedBy(mode);
    EXPECT_EQ(lengthsOf(readText("t,u,y\n" + sampleRows(0, 30, 0.5), whole)), (Lengths{31}));
  }
}

TEST(CsvFiles, AColumnNamesTheRunsAndEachIsDividedFurther) {
  Configuration configuration = dividedBy(ExperimentMode::duration, 15);
  configuration.experiment.column = "run";
  const LoadedData data = readText(
      "t,u,y,run\n" + sampleRows(0, 29, 0.5, ",7") + sampleRows(0, 59, 0.5, ",8"), configuration);
  EXPECT_EQ(idsOf(data), (Ids{"7_000", "8_000", "8_001"}));
  EXPECT_EQ(lengthsOf(data), (Lengths{30, 30, 30}));
}

TEST(CsvFiles, PausesOfTheLoggerDivideARecord) {
  const std::string before = "t,u,y,temp\n" + sampleRows(0, 39, 0.5, ",4");
  const LoadedData data = readText(before + sampleRows(100, 149, 0.5, ",5"));
  EXPECT_EQ(idsOf(data), (Ids{"log_000", "log_001"}));
  EXPECT_EQ(lengthsOf(data), (Lengths{40, 50}));
  EXPECT_EQ(data.experiments.at(1).u(0), 100);
  EXPECT_EQ(data.experiments.at(1).start_time, 50);
  EXPECT_TRUE(anyMentions(
      data.warnings, "'log': the stamps pause 1 time, for 30.5 s, first after 19.5 s; it was"));
  EXPECT_EQ(lengthsOf(readText(before + sampleRows(59, 149, 0.5, ",5"))),
            (Lengths{150}));  // 20 samples
  // A logger that writes when something happens has no pauses.
  std::string events = "t,u,y\n";
  for (int k = 0, at = 0; k < 60; at += 1 << (k++ % 7)) events += sampleRows(at, at, 0.01);
  EXPECT_EQ(idsOf(readText(events + sampleRows(9999, 9999, 0.01))), (Ids{"log"}));
}

TEST(CsvFiles, SignalsMayBeSampledInDifferentRows) {
  std::string content = "__time,/cmd/data,/odom/v\n";
  for (int k = 0; k < 50; ++k)
    content += std::to_string(0.5 * k) + "," + std::to_string(k) + ",\n" +
               std::to_string(0.5 * k + 0.1) + ",," + std::to_string(10 * k) + "\n";
  Configuration configuration;
  configuration.input.column = "/cmd/data";
  configuration.output.column = "/odom/v";
  const LoadedData data = readText(content, configuration);
  ASSERT_EQ(lengthsOf(data), (Lengths{50}));
  EXPECT_EQ(data.experiments.at(0).sample_time, 0.5);
  EXPECT_EQ(data.experiments.at(0).u(7), 7);
  EXPECT_EQ(data.experiments.at(0).y(7), 70);
  EXPECT_TRUE(data.experiments.at(0).valid.empty());
  EXPECT_TRUE(anyMentions(data.warnings, "50 of 100 rows have no input"));
}

TEST(CsvFiles, CovariatesAreThoseNamedOrAllThatAreLeft) {
  const std::string content = "t,u,y,temp [K],load,note\n0,1,1,300,5,a\n0.5,2,2,310,5,b\n";
  const LoadedData all = readText(content);
  EXPECT_EQ(all.experiments.at(0).signals.at("temp [K]"), Eigen::Vector2d(300, 310));
  EXPECT_EQ(all.experiments.at(0).scalars, (std::map<std::string, double>{{"load", 5}}));
  ASSERT_EQ(all.warnings.size(), 1u);
  EXPECT_TRUE(test::mentions(all.warnings[0], "the text columns 'note' are passed over"));

  Configuration named;
  named.covariates = {{"celsius", "", "auto", "temp", 1, -273}};
  const LoadedData one = readText(content, named);
  EXPECT_EQ(one.experiments.at(0).signals.at("celsius"), Eigen::Vector2d(27, 37));
  EXPECT_TRUE(one.experiments.at(0).scalars.empty());
  EXPECT_TRUE(anyMentions(one.warnings, "the columns 'load,note' are not used"));

  named.covariates[0].column = "note";
  EXPECT_TRUE(test::mentions(readText(content, named).rejected.at(0).reason,
                             "line 2, column note: found 'a'"));
}

TEST(CsvFiles, ThousandsOfColumnsAreRead) {
  std::string header = "t,u,y", cells;
  for (int c = 0; c < 5000; ++c) header += ",signal_" + std::to_string(c), cells += ",1";
  const std::string content = header + "\n" + sampleRows(0, 99, 0.5, cells);
  EXPECT_EQ(readText(content).experiments.at(0).scalars.size(), 5000u);
  Configuration configuration;
  configuration.output.column = "signal_77x";
  const std::string message =
      messageOf<ConfigurationError>([&] { readText(content, configuration); });
  EXPECT_TRUE(test::mentions(message, "the nearest name is 'signal_77'"));
  EXPECT_LT(message.size(), 400u);
}

TEST(CsvFiles, ATimeThatIsProbablyNotInSecondsIsTold) {
  const auto warnings = [](const std::string& name, double step, TimeUnit unit) {
    Configuration configuration;
    configuration.time.unit = unit;
    return readText(name + ",u,y\n" + sampleRows(0, 40, step), configuration).warnings;
  };
  EXPECT_TRUE(anyMentions(warnings("t", 20, TimeUnit::automatic),
                          "t holds whole numbers 20 apart, taken for seconds: if they are "
                          "milliseconds, write time: {unit: ms}"));
  EXPECT_TRUE(anyMentions(warnings("t", 12.5, TimeUnit::automatic), "t holds stamps 12.5 apart"));
  EXPECT_TRUE(anyMentions(warnings("t", 1e-7, TimeUnit::automatic), "t holds stamps 1e-07 apart"));
  EXPECT_TRUE(warnings("t", 20, TimeUnit::milliseconds).empty());
  EXPECT_TRUE(warnings("t", 20, TimeUnit::seconds).empty());
  EXPECT_TRUE(warnings("t", 10, TimeUnit::seconds).empty());
  EXPECT_TRUE(anyMentions(warnings("t", 1, TimeUnit::automatic),
                          "t holds whole numbers 1 apart, taken for seconds: if they are "
                          "milliseconds, write time: {unit: ms}; if they count the rows, time: "
                          "{unit: index, sample_time: 0.01}"));
  EXPECT_TRUE(warnings("t", 2.5, TimeUnit::automatic).empty());
  EXPECT_EQ(warnings("time_ms", 20, TimeUnit::automatic),
            (Ids{"the columns were read as follows: the time is 'time_ms' in ms"}));
}

TEST(CsvFiles, CountedRowsNeedNoStamps) {
  Configuration counted;
  counted.time.unit = TimeUnit::index;
  counted.time.sample_time = 0.25;
  const LoadedData data = readText("time,u,y\n9,1,2\n9,3,4\n9,5,6\n", counted);
  EXPECT_EQ(data.experiments.at(0).sample_time, 0.25);
  EXPECT_TRUE(data.experiments.at(0).scalars.empty());  // the time is no covariate
}

TEST(CsvFiles, ASampleTimeAloneCountsTheRows) {
  Configuration counted;
  counted.time.sample_time = 0.25;
  EXPECT_EQ(readText("time,u,y\n9,1,2\n9,3,4\n9,5,6\n", counted).experiments.at(0).sample_time,
            0.25);
}

TEST(CsvFiles, TheFirstColumnWithoutANameIsColumn1AlsoWhereItIsTheTime) {
  Configuration named;
  named.time.column = "column1";
  named.input.column = "column2";
  named.output.column = "column3";
  const LoadedData data = readText("0 1 2\n0.5 3 4\n1.0 5 6\n1.5 7 8\n", named);
  EXPECT_EQ(data.experiments.at(0).sample_time, 0.5);
  EXPECT_EQ(data.experiments.at(0).u[1], 3);
}

TEST(CsvFiles, WhatIsAssumedIsToldInOneRemark) {
  const LoadedData data = readText("Time;u;y;mode\n0;0,5;1;a\n0,5;0,5;2;b\n1;0,7;3;b\n");
  EXPECT_EQ(data.warnings, (Ids{"the columns were read as follows: the time is 'Time' in s "
                                "(assumed); the text columns 'mode' are passed over; commas are "
                                "decimal points"}));
}

TEST(CsvFiles, LinesLongerThanTheBlockOfReadingAreWhole) {
  const std::string filler(700000, ' ');
  const LoadedData data = readText("t,u,y\n" + sampleRows(0, 9, 0.5) + "5," + filler + "10,100\n" +
                                   sampleRows(11, 60000, 0.5));
  EXPECT_EQ(lengthsOf(data), (Lengths{60001}));
  for (int k = 0; k <= 60000; ++k) ASSERT_EQ(data.experiments.at(0).y(k), 10 * k);
}

}  // namespace
}  // namespace uncertainty_identification
