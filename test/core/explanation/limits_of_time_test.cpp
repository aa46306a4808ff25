#include "explanation/limits_of_time.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

Split slowRecord(int samples) {
  Split data;
  Experiment experiment;
  experiment.sample_time = 0.001;
  experiment.u = Eigen::VectorXd::Ones(samples);
  experiment.y.resize(samples);
  for (int k = 0; k < samples; ++k) experiment.y[k] = std::sin(2 * M_PI * k / 2400);
  data.train = data.held = {experiment};
  return data;
}

TEST(LimitsOfTime, LongSlowRecordsAreThinnedAndItIsTold) {
  Split data = slowRecord(40000);
  const std::string told = thinLongRecords(&data);
  EXPECT_EQ(data.train[0].samples(), 5000);
  EXPECT_EQ(data.held[0].samples(), 5000);
  EXPECT_DOUBLE_EQ(data.train[0].sample_time, 0.008);
  EXPECT_TRUE(test::mentions(told, "40000 samples")) << told;
  EXPECT_TRUE(test::mentions(told, "0.008 s")) << told;
}

TEST(LimitsOfTime, ShortRecordsStayAsTheyAre) {
  Split data = slowRecord(4000);
  EXPECT_EQ(thinLongRecords(&data), "");
  EXPECT_EQ(data.train[0].samples(), 4000);
}

TEST(LimitsOfTime, ThePlantThatIsSimpleEnoughIsValid) {
  for (const int order : {0, 1, 4}) {
    const NominalModelOptions nominal = ofOrder(order);
    EXPECT_FALSE(nominal.orders_auto);
    EXPECT_EQ(nominal.na, std::max(1, order));
    EXPECT_NO_THROW(nominal.validate());
  }
}

}  // namespace
}  // namespace uncertainty_identification
