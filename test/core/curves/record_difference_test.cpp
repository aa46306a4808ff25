// What a record that was not fitted to has otherwise than the others.
#include "curves/record_difference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

/// y(k) = 0.9 y(k-1) + 0.1 u(k-1): gain 1, pole 0.9.
CurveModel lag() {
  CurveModel model;
  model.theta = Eigen::Vector3d(-0.9, 0.1, 0);
  return model;
}

/// A record in two windows of 150 samples: input in steps of 10 samples, and the output of the lag
/// with another gain, offset and dead time, in noise of 0.01.
SimulationData record(double gain, double offset, int delay) {
  constexpr int kSamples = 300, kHalf = 150;
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  Eigen::VectorXd u(kSamples), x(kSamples), y(kSamples);
  for (int k = 0; k < kSamples; ++k) {
    u[k] = k % 10 == 0 ? normal(engine) : u[k - 1];
    x[k] = k == 0 ? 0 : 0.9 * x[k - 1] + 0.1 * u[std::max(0, k - 1 - delay)];
    y[k] = gain * x[k] + offset + 0.01 * normal(engine);
  }
  SimulationData data;
  data.sample_time = 0.5;
  data.scales.y.unit = 20;
  data.longest = kHalf;
  data.samples = kSamples;
  for (const int begin : {0, kHalf}) {
    SimulationWindow window;
    window.record = 3;
    window.u = u.segment(begin, kHalf);
    window.plays = playsOf(window.u);
    window.y = y.segment(begin, kHalf);
    window.measured = Eigen::ArrayXd::Ones(kHalf);
    data.windows.push_back(window);
  }
  return data;
}

// Tolerances: some standard errors of a mean of 300 samples in noise of 0.01, 0.0006.

TEST(RecordDifference, IsAGainWithAnOffset) {
  const auto found = differenceOf(record(2.5, 1, 0), lag());
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->in, RecordDifference::In::gain);
  EXPECT_EQ(found->record, 3);
  EXPECT_NEAR(found->value, 2.5, 0.02);
  EXPECT_GT(found->fit_after, 95);
  EXPECT_LT(found->fit_before, 50);
}

TEST(RecordDifference, IsAnOffsetInUnitsOfTheOutput) {
  const auto found = differenceOf(record(1, 1, 0), lag());
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->in, RecordDifference::In::offset);
  EXPECT_NEAR(found->value, 20, 0.1);
}

TEST(RecordDifference, IsADelayInSeconds) {
  const auto found = differenceOf(record(1, 0, 3), lag());
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->in, RecordDifference::In::delay);
  EXPECT_EQ(found->value, 1.5);
  EXPECT_TRUE(test::mentions(inWords(*found, "run_4"), "'run_4' was not fitted to"));
  EXPECT_TRUE(test::mentions(inWords(*found, "run_4"), "acts 1.5 s later"));
}

TEST(RecordDifference, OfAPlantThatAnswersAtOnceIsTheShiftOfItsOutput) {
  CurveModel direct;
  direct.direct = true;
  direct.theta = Eigen::Vector4d(0, 0, 1, 0);  // y = u
  SimulationData data = record(1, 0, 0);
  for (SimulationWindow& window : data.windows) window.y = window.u.array() + 2;
  const auto found = differenceOf(data, direct);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->in, RecordDifference::In::offset);
  EXPECT_NEAR(found->value, 40, 0.1) << "2 standard deviations of 20";
}

TEST(RecordDifference, IgnoresWhatWasNotMeasuredAndTellsOfTheWorstRecord) {
  SimulationData data = record(2.5, 1, 0);
  SimulationData longer = record(1, 1, 0);  // less wrong, and more of it
  for (SimulationWindow& window : data.windows) {
    window.record = 7;
    window.y.segment(60, 20).setConstant(1e3);
    window.measured.segment(60, 20).setZero();
  }
  for (int k = 0; k < 20; ++k)
    data.windows.insert(data.windows.end(), longer.windows.begin(), longer.windows.end());
  const auto found = differenceOf(data, lag());
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->record, 7);
  EXPECT_EQ(found->in, RecordDifference::In::gain);
  EXPECT_NEAR(found->value, 2.5, 0.02);
}

TEST(RecordDifference, IsNoneWhereTheRecordIsLikeTheOthersOrDiffersInMore) {
  EXPECT_FALSE(differenceOf(record(1, 0, 0), lag()).has_value());
  CurveModel other = lag();
  other.theta[0] = 0.5;  // alternates
  EXPECT_FALSE(differenceOf(record(1, 0, 0), other).has_value());
}

}  // namespace
}  // namespace uncertainty_identification
