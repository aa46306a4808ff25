#include <gtest/gtest.h>

#include <cmath>

#include "ros/summary_publisher.h"
#include "support/core_setup.h"
#include "support/plain_estimate.h"

namespace uncertainty_identification {
namespace {

Result someResult() {
  Result result{test::plainEstimate(test::vectorOf({1.0}), test::vectorOf({-0.5})), {}};
  result.estimate.noise_variance.value = 0.25;
  result.estimate.experiment_count = 12;
  result.physical.numbers = {{"gain", "", 2, 1.8, 2.2, 0.1},
                             {"time_constant_1", "s", 3},
                             {"time_constant_2", "s", 1},
                             {"dead_time", "s", 0.5, 0.4, 0.6}};
  SimulatedRun median;
  median.rank = "median";
  median.fit_percent = 87;
  result.runs = {median};
  return result;
}

TEST(SummaryMessage, HasTheNumbersOfTheResult) {
  ResultContext context;
  context.sequence = 7;
  context.stamp = 1500000000;
  context.preliminary = true;
  const messages::Summary summary = toMessage(someResult(), context, 3);
  EXPECT_EQ(summary.header.stamp, ros::Time(1.5));
  EXPECT_EQ(summary.sequence, 7U);
  EXPECT_TRUE(summary.preliminary);
  EXPECT_TRUE(summary.trusted);
  EXPECT_EQ(summary.static_gain.value, 2);
  EXPECT_EQ(summary.static_gain.lower, 1.8);
  EXPECT_EQ(summary.static_gain.upper, 2.2);
  EXPECT_EQ(summary.static_gain.spread, 0.1);
  EXPECT_EQ(summary.time_constant.value, 3);
  EXPECT_EQ(summary.dead_time.value, 0.5);
  EXPECT_EQ(summary.noise_standard_deviation, 0.5);
  EXPECT_EQ(summary.fit, 87);
  EXPECT_EQ(summary.accepted, 12U);
  EXPECT_EQ(summary.rejected, 3U);
}

TEST(SummaryMessage, HasNaNForWhatIsNotKnown) {
  const messages::Summary summary = toMessage(someResult(), {}, 0);
  EXPECT_TRUE(std::isnan(summary.time_constant.lower));
  EXPECT_TRUE(std::isnan(summary.dead_time.spread));
  EXPECT_TRUE(std::isnan(summary.bandwidth.value));
  EXPECT_TRUE(std::isnan(summary.bandwidth.spread));
}

}  // namespace
}  // namespace uncertainty_identification
