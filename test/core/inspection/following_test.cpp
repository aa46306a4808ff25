#include "inspection/following.h"

#include <gtest/gtest.h>

#include <random>

namespace uncertainty_identification {
namespace {

constexpr double kPeriod = 0.05;  // [s]

Channel channelOf(const std::vector<double>& values) {
  Channel channel;
  channel.records.resize(1);
  for (std::size_t k = 0; k < values.size(); ++k) {
    channel.records.front().stamps.push_back(static_cast<double>(k) * kPeriod);
    channel.records.front().values.push_back(values[k]);
  }
  return channel;
}

/// y(t) = 0.8 y(t-1) + u(t-dead) + noise, u a random telegraph signal minus feedback y(t-1).
struct Loop {
  Channel u, y;
};

Loop simulatedLoop(double feedback, double noise, std::size_t dead, std::size_t samples = 3000) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<double> u(samples, 0), y(samples, 0);
  double level = 1;
  for (std::size_t k = 1; k < samples; ++k) {
    if (k % 7 == 0 && random() % 2 == 0) level = -level;
    y[k] = 0.8 * y[k - 1] + (k >= dead ? u[k - dead] : 0) + noise * normal(random);
    u[k] = level - feedback * y[k - 1];
  }
  return {channelOf(u), channelOf(y)};
}

TEST(Following, SeesTheOutputFollowAfterItsDeadTime) {
  const Loop open = simulatedLoop(0, 0.1, 4);
  const Following found = followingOf(open.u, open.y, 0, kPeriod);
  EXPECT_TRUE(found.outputFollows());
  EXPECT_FALSE(found.inputFollows());
  EXPECT_NEAR(found.delay, 4 * kPeriod, 1e-9);
  EXPECT_GT(found.after, 0.8);
}

TEST(Following, ExchangedSignalsFollowTheOtherWayRound) {
  const Loop open = simulatedLoop(0, 0.1, 4);
  const Following found = followingOf(open.y, open.u, 0, kPeriod);
  EXPECT_FALSE(found.outputFollows());
  EXPECT_TRUE(found.inputFollows());
  EXPECT_NEAR(found.lead, 4 * kPeriod, 1e-9);
}

TEST(Following, SeesAController) {
  const Loop closed = simulatedLoop(0.4, 1, 1);
  const Following found = followingOf(closed.u, closed.y, 0, kPeriod);
  EXPECT_TRUE(found.outputFollows());
  EXPECT_TRUE(found.inputFollows()) << found.before << " by chance " << found.chance;
}

TEST(Following, OfUnrelatedSignalsIsChance) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::vector<double> a, b;
  for (int k = 0; k < 2000; ++k) {
    a.push_back(normal(random));
    b.push_back(normal(random));
  }
  const Following found = followingOf(channelOf(a), channelOf(b), 0, kPeriod);
  EXPECT_TRUE(found.measured);
  EXPECT_FALSE(found.outputFollows());
  EXPECT_FALSE(found.inputFollows());
}

// What ten samples of the past do not predict of such an input depends on what was new in it
// before.
TEST(Following, AnInputThatHoldsItsValuesIsNotTakenForAController) {
  std::vector<double> held, answer;
  std::mt19937_64 random(7);
  for (int k = 0; k < 2000; ++k) {
    answer.push_back(k == 0 ? 0 : 0.5 * answer.back() + held.back());
    held.push_back(k % 17 == 0 ? (random() % 2 == 0 ? 1 : -1) : held.back());
  }
  const Following found = followingOf(channelOf(held), channelOf(answer), 0, kPeriod);
  EXPECT_TRUE(found.outputFollows());
  EXPECT_FALSE(found.inputFollows()) << found.before << " after " << found.after;
}

TEST(Following, IsNotMeasuredWithoutSamplesInCommon) {
  const Loop open = simulatedLoop(0, 0.1, 1, 60);
  EXPECT_FALSE(followingOf(open.u, open.y, 0, kPeriod).measured) << "too few";
  Channel late = open.y;
  for (double& stamp : late.records.front().stamps) stamp += 1e6;
  EXPECT_FALSE(followingOf(open.u, late, 0).measured);
  EXPECT_FALSE(followingOf(Channel(), Channel(), 0).measured);
}

TEST(Following, ThinsByTheBandOfTheOutput) {
  const Loop open = simulatedLoop(0, 0.1, 4);
  EXPECT_DOUBLE_EQ(followingOf(open.u, open.y, 1).period, 0.1) << "ten samples a period of 1 Hz";
  EXPECT_DOUBLE_EQ(followingOf(open.u, open.y, 100).period, kPeriod) << "its own rate";
}

}  // namespace
}  // namespace uncertainty_identification
