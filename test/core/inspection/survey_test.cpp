#include "inspection/survey.h"

#include <gtest/gtest.h>

#include <limits>

namespace uncertainty_identification {
namespace {

TEST(Survey, SummarisesRegularStamps) {
  std::vector<double> stamps;
  for (int k = 0; k < 101; ++k) stamps.push_back(5 + 0.02 * k);
  const StampSummary summary = summaryOf(stamps);
  EXPECT_EQ(summary.count, 101);
  EXPECT_DOUBLE_EQ(summary.period, 0.02);
  EXPECT_TRUE(summary.uniform);
  EXPECT_EQ(summary.pauses, 0);
  EXPECT_DOUBLE_EQ(summary.start, 5);
  EXPECT_DOUBLE_EQ(summary.end, 7);
}

TEST(Survey, CountsPausesRepeatsAndSteps) {
  std::vector<double> stamps;
  for (int k = 0; k < 100; ++k) stamps.push_back(0.01 * k);
  for (int k = 0; k < 100; ++k) stamps.push_back(10 + 0.01 * k);
  stamps.push_back(stamps.back());
  stamps.push_back(3);
  stamps.push_back(std::numeric_limits<double>::quiet_NaN());
  const StampSummary summary = summaryOf(stamps);
  EXPECT_EQ(summary.pauses, 1);
  EXPECT_NEAR(summary.longest_pause, 9.01, 1e-9);
  EXPECT_EQ(summary.repeated, 1);
  EXPECT_EQ(summary.backward, 1);
  EXPECT_EQ(summary.count, 203);
}

TEST(Survey, OfNoOrOneStampHasNoPeriod) {
  EXPECT_EQ(summaryOf({}).period, 0);
  EXPECT_EQ(summaryOf({4}).period, 0);
  EXPECT_EQ(summaryOf({4, 4, 4}).repeated, 2);
}

/// A file with one record and these columns.
Survey fileWith(const std::vector<std::string>& columns, const std::string& remark) {
  Survey file;
  file.records = 1;
  file.remarks = {remark};
  file.times = {{"t", "s", true, ""}};
  for (const std::string& column : columns) {
    Channel channel;
    channel.name = channel.column = column;
    channel.records = {{{0, 1}, {2, 3}}};
    channel.empty = 1;
    file.channels.push_back(channel);
  }
  return file;
}

TEST(Survey, OfSeveralFilesJoinsChannelsOfTheSameName) {
  Survey all;
  append(fileWith({"u", "y"}, "first"), all);
  append(fileWith({"y", "z"}, "first"), all);
  ASSERT_EQ(all.channels.size(), 3u);
  EXPECT_EQ(all.records, 2u);
  EXPECT_EQ(all.remarks.size(), 1u);
  EXPECT_EQ(all.times.size(), 1u);
  for (const Channel& channel : all.channels) ASSERT_EQ(channel.records.size(), 2u);
  EXPECT_TRUE(all.channels[0].records[1].stamps.empty()) << "u is not in the second file";
  EXPECT_EQ(all.channels[1].records[1].stamps.size(), 2u);
  EXPECT_EQ(all.channels[1].empty, 2);
  EXPECT_TRUE(all.channels[2].records[0].stamps.empty()) << "z is not in the first file";
}

}  // namespace
}  // namespace uncertainty_identification
