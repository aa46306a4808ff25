#include "data/experiment_cutter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "support/cutter_setup.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using test::expectSpan;
using test::feed;
using test::kStep;
using test::mode;

TEST(Cutter, MarkersCutByStampHalfOpen) {
  ExperimentCutter cutter(mode(ExperimentMode::topic), {});
  feed(cutter, 0, 2);
  cutter.addMarker(2, true);
  feed(cutter, 2, 5);
  EXPECT_TRUE(cutter.running());
  cutter.addMarker(5, false);
  EXPECT_FALSE(cutter.running());
  EXPECT_TRUE(cutter.waiting());
  EXPECT_TRUE(
      cutter.takeFinished().empty());  // the signals have not shown that they are past the end
  cutter.addInput(5, 5);
  EXPECT_TRUE(cutter.takeFinished().empty());
  cutter.addOutput(5, -5);
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].id, "experiment_000");
  EXPECT_EQ(finished[0].start, 2);
  EXPECT_EQ(finished[0].end, 5);
  expectSpan(finished[0].output, 2, 5 - kStep);
  expectSpan(finished[0].input, 2, 5 - kStep);
  EXPECT_FALSE(cutter.waiting());
  EXPECT_TRUE(cutter.takeFinished().empty());
}

TEST(Cutter, KeepsTheNewestInputAndCovariateBeforeTheStart) {
  ExperimentCutter cutter(mode(ExperimentMode::topic), {});
  cutter.addInput(0, 1);
  cutter.addInput(1, 2);
  cutter.addCovariate("temp", 0.5, 20);
  cutter.addOutput(1, 9);
  cutter.addMarker(2, true, "heat");
  cutter.addInput(3, 3);
  for (double stamp = 2.5; stamp <= 4; stamp += 0.5) cutter.addOutput(stamp, 0);
  cutter.addMarker(4, false);
  cutter.addInput(4, 4);
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].id, "heat");
  EXPECT_EQ(finished[0].input.stamps, (std::vector<double>{1, 3}));
  EXPECT_EQ(finished[0].input.values, (std::vector<double>{2, 3}));
  EXPECT_EQ(finished[0].output.stamps, (std::vector<double>{2.5, 3, 3.5}));
  EXPECT_EQ(finished[0].covariates.at("temp").values, (std::vector<double>{20}));
}

TEST(Cutter, RepeatedMarkersChangeNothingAnotherNameDoes) {
  ExperimentCutter cutter(mode(ExperimentMode::topic), {});
  cutter.addMarker(0, false);
  for (const double stamp : {0.0, 0.5, 1.0}) cutter.addMarker(stamp, true, "a");
  feed(cutter, 0, 2);
  cutter.addMarker(2, true, "b");  // begins the next one without a pause
  feed(cutter, 2, 4);
  cutter.addMarker(4, false);
  cutter.addMarker(4.5, false);
  feed(cutter, 4, 4.5);
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 2u);
  EXPECT_EQ(finished[0].id, "a");
  expectSpan(finished[0].output, 0, 2 - kStep);
  EXPECT_EQ(finished[1].id, "b");
  expectSpan(finished[1].output, 2, 4 - kStep);
  expectSpan(finished[1].input, 2, 4 - kStep);
}

TEST(Cutter, LateMarkersCutTheSamplesThatCameBefore) {
  ExperimentCutter cutter(mode(ExperimentMode::topic), {});
  feed(cutter, 0, 10);
  cutter.addMarker(3, true);
  cutter.addMarker(6, false);
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 1u);
  expectSpan(finished[0].output, 3, 6 - kStep);
}

/// One message of any topic.
struct Message {
  double stamp;
  std::function<void(ExperimentCutter&)> deliver;
};

std::vector<std::vector<Message>> threeExperiments(ExperimentMode mode) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> jitter(0, 0.05);
  std::vector<std::vector<Message>> topics(4);
  for (int k = 0; k < 400; ++k) {
    if (mode == ExperimentMode::gap && k % 120 > 100) continue;
    const double input = 0.1 * k + jitter(engine), output = 0.1 * k + jitter(engine);
    topics[0].push_back({input, [=](ExperimentCutter& cutter) { cutter.addInput(input, k); }});
    topics[1].push_back(
        {output, [=](ExperimentCutter& cutter) { cutter.addOutput(output, 2 * k); }});
    const double other = output + 0.001;
    if (k % 10 == 0 && k < 300) {
      topics[2].push_back(
          {other, [=](ExperimentCutter& cutter) { cutter.addCovariate("temp", other, k); }});
    }
  }
  for (const auto& [stamp, active] : {std::make_pair(3.0, true),
                                      {12.0, false},
                                      {13.0, true},
                                      {20.0, false},
                                      {20.05, true},
                                      {33.0, false}}) {
    const double time = stamp;
    const bool state = active;
    topics[3].push_back({stamp, [=](ExperimentCutter& cutter) { cutter.addMarker(time, state); }});
  }
  return topics;
}

/// Merges the topics, each in its own order, as if each message took up to `delay` [s] to arrive.
std::vector<Recording> delivered(ExperimentMode kind, double seconds, double delay,
                                 std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> lateness(0, delay);
  std::vector<std::pair<double, Message>> arrivals;
  for (const auto& topic : threeExperiments(kind)) {
    double arrival = 0;
    for (const Message& message : topic) {
      arrival = std::max(arrival, message.stamp + lateness(engine));
      arrivals.emplace_back(arrival, message);
    }
  }
  std::stable_sort(arrivals.begin(), arrivals.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  ExperimentCutter cutter(mode(kind, seconds), {});
  for (const auto& [arrival, message] : arrivals) message.deliver(cutter);
  cutter.flush();
  EXPECT_TRUE(cutter.takeRejected().empty());
  return cutter.takeFinished();
}

void expectEqual(const StampedSignal& one, const StampedSignal& other) {
  EXPECT_EQ(one.stamps, other.stamps);
  EXPECT_EQ(one.values, other.values);
}

class AnyArrival : public testing::TestWithParam<std::tuple<ExperimentMode, double, std::size_t>> {
};

TEST_P(AnyArrival, GivesTheSameExperiments) {
  const auto [kind, seconds, count] = GetParam();
  const auto expected = delivered(kind, seconds, 0, 1);
  ASSERT_EQ(expected.size(), count);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto found = delivered(kind, seconds, 0.9, seed);
    ASSERT_EQ(found.size(), count) << seed;
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(found[i].id, expected[i].id);
      EXPECT_EQ(found[i].start, expected[i].start);
      EXPECT_EQ(found[i].end, expected[i].end);
      expectEqual(found[i].input, expected[i].input);
      expectEqual(found[i].output, expected[i].output);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, AnyArrival,
                         testing::Values(std::make_tuple(ExperimentMode::topic, 0.0, 3),
                                         std::make_tuple(ExperimentMode::duration, 7.0, 6),
                                         std::make_tuple(ExperimentMode::gap, 1.0, 4)));

TEST(Cutter, ServicesBeginFinishAndDiscard) {
  ExperimentCutter cutter(mode(ExperimentMode::service), {});
  cutter.addMarker(0, true);  // not listened to in this mode
  EXPECT_FALSE(cutter.running());
  EXPECT_FALSE(cutter.finish(0));
  EXPECT_FALSE(cutter.discard());
  EXPECT_TRUE(cutter.begin(1));
  EXPECT_FALSE(cutter.begin(1.5));
  feed(cutter, 0, 3);
  EXPECT_TRUE(cutter.discard());
  EXPECT_TRUE(cutter.begin(3));
  feed(cutter, 3, 6);
  EXPECT_TRUE(cutter.finish(6));
  EXPECT_FALSE(cutter.finish(6));
  EXPECT_TRUE(cutter.waiting());
  cutter.releaseClosed();  // the topics fell silent
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].id, "experiment_001");
  expectSpan(finished[0].output, 3, 6 - kStep);
  EXPECT_TRUE(finished[0].note.empty());
}

TEST(Cutter, ReleaseClosedLeavesTheRunningExperiment) {
  ExperimentCutter cutter(mode(ExperimentMode::topic), {});
  cutter.addMarker(0, true);
  feed(cutter, 0, 1);
  cutter.releaseClosed();
  EXPECT_TRUE(cutter.running());
  EXPECT_TRUE(cutter.takeFinished().empty());
}

}  // namespace
}  // namespace uncertainty_identification
