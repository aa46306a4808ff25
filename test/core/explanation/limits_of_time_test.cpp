#include "explanation/limits_of_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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

/// First-order plants with white noise.
std::vector<Experiment> plants() {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<Experiment> all(6);
  for (Experiment& experiment : all) {
    experiment.id = std::to_string(&experiment - all.data());
    experiment.sample_time = 0.1;
    experiment.u.resize(300);
    experiment.y.resize(300);
    double x = 0;
    for (int k = 0; k < 300; ++k) {
      experiment.u[k] = k % 15 == 0 ? normal(random) : experiment.u[k - 1];
      experiment.y[k] = x + 0.05 * normal(random);
      x = 0.8 * x + 0.2 * experiment.u[k];
    }
  }
  return all;
}

/// So little time that no choice ends, be it with the best model found until then or without any.
TEST(LimitsOfTime, AModelIsIdentifiedHoweverLittleTimeThereIs) {
  Configuration configuration;
  configuration.nominal_model.orders_auto = true;
  for (const double limit : {1e-6, 0.2, 1000.0}) {
    configuration.explanation.time_limit = limit;
    Configuration own = configuration;
    std::string remark;
    const Estimate chosen = identifyInTime(0.5, 1, plants(), {}, &own, &remark);
    EXPECT_TRUE(chosen.usable()) << limit;
    EXPECT_EQ(chosen.configuration.estimation.time_limit, 0) << "is the user's";
    if (limit == 1000) EXPECT_EQ(remark, "");
    if (limit == 1e-6) {
      EXPECT_TRUE(test::mentions(remark, "left no time to choose a model")) << remark;
      EXPECT_EQ(own.nominal_model.na, 1);
      EXPECT_FALSE(own.nominal_model.orders_auto);
    }
  }
}

}  // namespace
}  // namespace uncertainty_identification
