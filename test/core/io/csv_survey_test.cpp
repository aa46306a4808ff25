#include "io/csv_survey.h"

#include <gtest/gtest.h>

#include <fstream>

#include "support/error_message.h"
#include "support/mentions.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

class CsvSurvey : public testing::Test {
 protected:
  Survey survey(const std::string& content, const Configuration& configuration = {}) {
    std::ofstream(folder_ / "log.csv") << content;
    return surveyCsv(folder_ / "log.csv", configuration);
  }

  static std::vector<std::string> names(const Survey& found) {
    std::vector<std::string> all;
    for (const Channel& channel : found.channels) all.push_back(channel.name);
    return all;
  }

  const TemporaryFolder folder_;
};

using Names = std::vector<std::string>;

TEST_F(CsvSurvey, ReadsEveryColumnOfNumbers) {
  const Survey found = survey(
      "time_ms;motor_voltage;state;w "
      "[rad/s]\n0;1,5;on;2\n10;1,5;on;\n20;-2;off;nan\n30;0;on;inf\n");
  EXPECT_EQ(names(found), (Names{"motor_voltage", "w [rad/s]"}));
  EXPECT_EQ(found.channels[0].records.front().values, (std::vector<double>{1.5, 1.5, -2, 0}));
  EXPECT_EQ(found.channels[0].unit, "V");
  EXPECT_EQ(found.channels[1].unit, "rad/s");
  EXPECT_EQ(found.channels[1].empty, 2);
  EXPECT_EQ(found.channels[1].not_finite, 1);
  ASSERT_EQ(found.streams.size(), 1u);
  EXPECT_EQ(found.streams[0].stamps.count, 4);
  EXPECT_DOUBLE_EQ(found.streams[0].stamps.period, 0.01);
  ASSERT_EQ(found.times.size(), 1u);
  EXPECT_EQ(found.times[0].column, "time_ms");
  EXPECT_EQ(found.times[0].unit, "ms");
  EXPECT_FALSE(found.times[0].assumed);
  EXPECT_TRUE(test::anyMentions(found.remarks, "columns of text, passed over: 'state'"));
}

TEST_F(CsvSurvey, DividesByAColumnOfRuns) {
  const Survey found = survey("run,t,u,y\na,0,1,2\na,1,1,2\nb,0,3,4\nb,1,3,4\n");
  EXPECT_EQ(names(found), (Names{"u", "y"}));
  EXPECT_EQ(found.records, 2u);
  EXPECT_EQ(found.times[0].experiments, "run");
  EXPECT_TRUE(found.times[0].assumed);
  EXPECT_EQ(found.streams[1].name, "b");
  EXPECT_EQ(found.channels[0].records[1].values, (std::vector<double>{3, 3}));
}

TEST_F(CsvSurvey, CountsRowsWithoutTime) {
  const Survey found = survey("a,b\n1,2\n3,4\n");
  EXPECT_EQ(found.times[0].unit, "index");
  EXPECT_EQ(found.times[0].column, "");
  EXPECT_TRUE(test::anyMentions(found.remarks, "the rows are counted"));
  const Survey worded = survey("timestamp,a\nnoon,2\nevening,4\n");
  EXPECT_EQ(worded.times[0].unit, "index");
  EXPECT_TRUE(test::anyMentions(worded.remarks, "neither numbers nor dates or times of day"));
}

TEST_F(CsvSurvey, ReadsDates) {
  const Survey found = survey("when,a\n2024-01-01 10:00,2\n2024-01-01 10:01,4\n");
  EXPECT_EQ(found.times[0].column, "when");
  EXPECT_EQ(found.times[0].unit, "dates");
  EXPECT_FALSE(found.times[0].assumed);
  EXPECT_EQ(found.streams[0].stamps.period, 60);
  EXPECT_EQ(names(found), Names{"a"});
}

TEST_F(CsvSurvey, TakesTheFirstOfSeveralTimes) {
  const Survey found = survey("stamp,time_ms,a\n0,0,1\n0.5,500,2\n");
  EXPECT_EQ(found.times[0].column, "stamp");
  EXPECT_TRUE(test::anyMentions(found.remarks, "the time could be 'stamp' or 'time_ms'"));
  Configuration configuration;
  configuration.time.column = "time_ms";
  EXPECT_EQ(survey("stamp,time_ms,a\n0,0,1\n0.5,500,2\n", configuration).times[0].unit, "ms");
}

TEST_F(CsvSurvey, SaysWhyAnExperimentEnds) {
  const Survey found = survey("t,u,y\n0,1,2\n1,1,2\n0.5,1,2\n");
  EXPECT_NE(found.streams[0].remark.find("line 4"), std::string::npos) << found.streams[0].remark;
  EXPECT_EQ(found.streams[0].stamps.count, 2);
}

TEST_F(CsvSurvey, RefusesWhatHoldsNoNumbers) {
  EXPECT_NE(
      messageOf<FileError>([&] { survey("t,name\n0,a\n1,b\n"); }).find("no column of numbers"),
      std::string::npos);
  EXPECT_NE(messageOf<FileError>([&] { survey(""); }).find("empty"), std::string::npos);
  const Survey twice = survey("t,a,a,b\n0,1,1,2\n1,1,1,3\n");
  EXPECT_EQ(names(twice), (Names{"b"}));
  EXPECT_TRUE(test::anyMentions(twice.remarks, "columns of the same name, passed over: 'a', 'a'"));
}

}  // namespace
}  // namespace uncertainty_identification
