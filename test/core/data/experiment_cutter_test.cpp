#include "data/experiment_cutter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr double kStep = 0.125;  // [s], exact in binary, so that stamps can be compared

ExperimentOptions mode(ExperimentMode mode, double seconds = 0) {
  ExperimentOptions options;
  options.mode = mode;
  options.duration = options.gap = seconds;
  return options;
}

LimitOptions limit(int max_samples) {
  LimitOptions limits;
  limits.max_samples = max_samples;
  return limits;
}

/// Both signals at from, from + kStep, ... up to but without to; the value tells the stamp.
void feed(ExperimentCutter& cutter, double from, double to) {
  for (double stamp = from; stamp < to; stamp += kStep) {
    cutter.addInput(stamp, stamp);
    cutter.addOutput(stamp, -stamp);
  }
}

bool mentions(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

void expectSpan(const StampedSignal& signal, double first, double last) {
  ASSERT_FALSE(signal.stamps.empty());
  EXPECT_EQ(signal.stamps.front(), first);
  EXPECT_EQ(signal.stamps.back(), last);
}

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

TEST(Cutter, DurationCutsConsecutiveWindows) {
  ExperimentCutter cutter(mode(ExperimentMode::duration, 2), {});
  cutter.addInput(0, 0);
  cutter.addInput(0.5, 1);
  feed(cutter, 1, 6.5);
  cutter.flush();
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 3u);
  expectSpan(finished[0].output, 1, 3 - kStep);  // from the first stamp at which both are present
  EXPECT_EQ(finished[1].start, 3);
  expectSpan(finished[1].output, 3, 5 - kStep);
  expectSpan(finished[2].output, 5, 6.5 - kStep);
  EXPECT_EQ(finished[2].id, "experiment_002");
}

TEST(Cutter, DurationStartsWithTheSignalThatComesLast) {
  ExperimentCutter cutter(mode(ExperimentMode::duration, 2), {});
  for (double stamp = 0; stamp < 1; stamp += kStep) cutter.addOutput(stamp, 0);
  feed(cutter, 1, 4);
  cutter.flush();
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 2u);
  expectSpan(finished[0].output, 1, 3 - kStep);
}

TEST(Cutter, SamplesOfAReleasedWindowAreTooLate) {
  ExperimentCutter cutter(mode(ExperimentMode::duration, 1), {});
  feed(cutter, 0, 0.75);
  cutter.addInput(1.5, 0);
  cutter.releaseClosed();
  ASSERT_EQ(cutter.takeFinished().size(), 1u);
  cutter.addOutput(0.875, 0);
  feed(cutter, 1.5, 1.75);
  cutter.flush();
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 1u);
  expectSpan(finished[0].output, 1.5, 1.75 - kStep);
}

TEST(Cutter, AHeldInputGoesWithEveryWindow) {
  ExperimentCutter cutter(mode(ExperimentMode::duration, 1), {});
  cutter.addInput(0, 7);  // published once
  for (double stamp = 0; stamp < 3; stamp += kStep) cutter.addOutput(stamp, 0);
  cutter.flush();
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 3u);
  for (const Recording& recording : finished) {
    EXPECT_EQ(recording.input.values, (std::vector<double>{7}));
  }
}

// 1 + 297 * 0.1 is a little more than 30.7, where the signals go on after a pause.
TEST(Cutter, DurationLosesNoSampleToRounding) {
  ExperimentCutter cutter(mode(ExperimentMode::duration, 0.1), {});
  int fed = 0;
  for (int run = 0; run < 100; ++run) {
    for (int k = 0; k < 100; ++k, ++fed) {
      const double stamp = static_cast<double>(100 + 110 * run + k) / 100;
      cutter.addInput(stamp, 1);
      cutter.addOutput(stamp, 1);
    }
  }
  cutter.flush();
  std::size_t cut = 0;
  for (const Recording& recording : cutter.takeFinished()) cut += recording.output.stamps.size();
  EXPECT_EQ(cut, static_cast<std::size_t>(fed));
}

TEST(Cutter, DurationPassesOverEmptyWindows) {
  ExperimentCutter cutter(mode(ExperimentMode::duration, 2), {});
  feed(cutter, 0, 2);
  feed(cutter, 1e6 + 1, 1e6 + 2);
  cutter.flush();
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 2u);
  EXPECT_EQ(finished[1].start, 1e6);
  EXPECT_EQ(finished[1].id, "experiment_001");
}

TEST(Cutter, GapEndsAnExperiment) {
  ExperimentCutter cutter(mode(ExperimentMode::gap, 1), {});
  feed(cutter, 0, 3);
  feed(cutter, 3.5, 5);  // not long enough a silence
  feed(cutter, 7, 9);
  ASSERT_EQ(cutter.takeFinished().size(), 1u);
  EXPECT_TRUE(cutter.running());
  cutter.flush();
  auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 1u);
  expectSpan(finished[0].output, 7, 9 - kStep);
  expectSpan(finished[0].input, 7, 9 - kStep);
  EXPECT_TRUE(finished[0].note.empty());
}

TEST(Cutter, FlushReleasesTheRunningExperimentWithANote) {
  ExperimentCutter cutter(mode(ExperimentMode::topic), {});
  cutter.addMarker(1, true, "last");
  feed(cutter, 0, 4);
  cutter.flush();
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 1u);
  expectSpan(finished[0].output, 1, 4 - kStep);
  EXPECT_TRUE(mentions(finished[0].note, "ended while it was running"));
  EXPECT_FALSE(cutter.running());
}

TEST(Cutter, DuplicateStampsAreLeftOutAndCounted) {
  ExperimentCutter cutter(mode(ExperimentMode::topic), {});
  cutter.addMarker(0, true);
  for (double stamp = 0; stamp < 3; stamp += 1) {
    cutter.addInput(stamp, 1);
    cutter.addOutput(stamp, 1);
    cutter.addOutput(stamp, 2);
    cutter.addInput(stamp, 3);  // in force from then on
  }
  cutter.flush();
  EXPECT_EQ(cutter.duplicates(), 6);
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].output.values, (std::vector<double>{1, 1, 1}));
  EXPECT_EQ(finished[0].input.values, (std::vector<double>{3, 3, 3}));
  EXPECT_EQ(finished[0].duplicate_stamps, 6);
}

TEST(Cutter, BackwardClockRejectsTheRunningExperimentAndGoesOn) {
  ExperimentCutter cutter(mode(ExperimentMode::topic), {});
  for (int loop = 0; loop < 3; ++loop) {
    cutter.addMarker(0, true, "first");
    feed(cutter, 0, 2);
    cutter.addMarker(2, false);
    cutter.addMarker(3, true, "second");
    feed(cutter, 2, 4);  // a bag that ends, and is looped, while the second one runs
  }
  cutter.flush();
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(finished[i].id, "first");
    expectSpan(finished[i].output, 0, 2 - kStep);
    EXPECT_EQ(finished[i].input.stamps.size(), 16u);
  }
  const auto rejected = cutter.takeRejected();
  ASSERT_EQ(rejected.size(), 2u);
  EXPECT_EQ(rejected[0].id, "second");
  EXPECT_TRUE(mentions(rejected[0].reason, "experiment 'second': the clock went back"))
      << rejected[0].reason;
  EXPECT_TRUE(mentions(rejected[0].reason, "marker stamps from 3 s to 0 s"));
  EXPECT_EQ(cutter.clockResets(), 2);
}

TEST(Cutter, ClosedExperimentsSurviveABackwardClock) {
  ExperimentCutter cutter(mode(ExperimentMode::topic), {});
  cutter.addMarker(0, true, "done");
  feed(cutter, 0, 2);
  cutter.addMarker(2, false);
  cutter.addOutput(0, 0);
  EXPECT_EQ(cutter.takeFinished().size(), 1u);
  EXPECT_TRUE(cutter.takeRejected().empty());
}

TEST(Cutter, StampsOfTheOldClockAreLeftOutAfterAReset) {
  ExperimentCutter cutter(mode(ExperimentMode::topic), {});
  feed(cutter, 100, 110);
  cutter.addOutput(0, 7);    // the output is reset first
  cutter.addInput(110, -1);  // while inputs of the old clock are still on their way
  cutter.addMarker(0, true);
  feed(cutter, kStep, 3);
  cutter.addMarker(3, false);
  feed(cutter, 3, 4);
  EXPECT_EQ(cutter.clockResets(), 1);
  EXPECT_EQ(cutter.dropped(), 1);
  EXPECT_TRUE(cutter.takeRejected().empty());
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 1u);
  expectSpan(finished[0].output, 0, 3 - kStep);
  expectSpan(finished[0].input, kStep, 3 - kStep);
}

TEST(Cutter, ASmallStepBackLosesOnlyTheRunningExperiment) {
  ExperimentCutter cutter(mode(ExperimentMode::topic), {});
  cutter.addMarker(0, true);
  feed(cutter, 0, 2);
  cutter.addOutput(1.75, 0);  // an unordered stamp
  feed(cutter, 2, 3);
  EXPECT_EQ(cutter.takeRejected().size(), 1u);
  cutter.addMarker(3, true);
  feed(cutter, 3, 5);
  cutter.addMarker(5, false);
  feed(cutter, 5, 6);
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 1u);
  expectSpan(finished[0].output, 3, 5 - kStep);
}

TEST(Cutter, MaxSamplesClosesAnExperiment) {
  ExperimentCutter cutter(mode(ExperimentMode::topic), limit(16));
  cutter.addMarker(0, true);
  feed(cutter, 0, 5);
  cutter.addMarker(5, false);
  feed(cutter, 5, 6);
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].output.stamps.size(), 16u);
  expectSpan(finished[0].output, 0, 2 - kStep);
  EXPECT_TRUE(mentions(finished[0].note, "max_samples (16)"));
}

TEST(Cutter, MaxSamplesIsIndependentOfArrival) {
  ExperimentCutter cutter(mode(ExperimentMode::topic), limit(16));
  cutter.addMarker(0, true);
  for (double stamp = 0; stamp < 3; stamp += kStep) cutter.addOutput(stamp, 0);
  for (double stamp = 0; stamp < 3; stamp += kStep / 2)
    cutter.addInput(stamp, 0);  // full at 1 s already
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].end, 1);
  EXPECT_EQ(finished[0].input.stamps.size(), 16u);
  EXPECT_EQ(finished[0].output.stamps.size(), 8u);
}

TEST(Cutter, ADeadInputDoesNotFillTheMemory) {
  ExperimentCutter cutter(mode(ExperimentMode::duration, 1), limit(100));
  cutter.addInput(0, 1);
  std::size_t released = 0;
  for (int k = 0; k < 10000; ++k) {
    cutter.addOutput(k * kStep, k);
    for (const Recording& recording : cutter.takeFinished()) {
      EXPECT_EQ(recording.output.stamps.size(), 8u);
      ++released;
    }
  }
  EXPECT_GE(released, 10000u / 8 - 30);
}

TEST(Cutter, ModeGapAndDurationGoOnAfterMaxSamples) {
  for (const auto kind : {ExperimentMode::gap, ExperimentMode::duration}) {
    ExperimentCutter cutter(mode(kind, 4), limit(16));
    feed(cutter, 0, 4);
    cutter.flush();
    const auto finished = cutter.takeFinished();
    ASSERT_EQ(finished.size(), 2u);
    expectSpan(finished[0].output, 0, 2 - kStep);
    expectSpan(finished[1].output, 2, 4 - kStep);
  }
}

TEST(Cutter, NonFiniteStampsAreLeftOut) {
  ExperimentCutter cutter(mode(ExperimentMode::duration, 1), {});
  cutter.addOutput(std::numeric_limits<double>::quiet_NaN(), 0);
  EXPECT_EQ(cutter.dropped(), 1);
}

TEST(Cutter, RefusesModesItCannotCut) {
  EXPECT_THROW(ExperimentCutter(mode(ExperimentMode::message), {}), ConfigurationError);
  EXPECT_THROW(ExperimentCutter(mode(ExperimentMode::duration, 0), {}), ConfigurationError);
  EXPECT_THROW(ExperimentCutter(mode(ExperimentMode::gap, 0), {}), ConfigurationError);
}

}  // namespace
}  // namespace uncertainty_identification
