#include "uncertainty_identification/data/signal_timing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "data/experiment_cutter.h"

namespace uncertainty_identification {
namespace {

constexpr double kPeriod = 0.01;       // [s]
constexpr double kTransport = 0.002;   // [s] the quickest
constexpr double kOutputAhead = 0.25;  // [s] of the output's clock

/// A signal whose stamps lie on a grid or `spread` off it, in turns, by a clock that is `ahead`.
/// Transport takes kTransport at best.
StampedSignal signalOf(int count, double ahead, double spread, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::exponential_distribution<double> queueing(1 / 0.005);
  StampedSignal signal;
  for (int k = 0; k < count; ++k) {
    const double due = 10 + k * kPeriod;
    signal.stamps.push_back(due + ahead + (k % 3 - 1) * spread);
    signal.values.push_back(k % 7);
    signal.arrivals.push_back(due + kTransport + (k == count / 2 ? 0 : queueing(random)));
  }
  return signal;
}

Recording recordingOf(double spread) {
  Recording recording;
  recording.id = "run";
  recording.input = signalOf(500, 0, 0, 1);
  recording.output = signalOf(500, kOutputAhead, spread, 2);
  return recording;
}

TEST(SignalTiming, TheLowerEnvelopeIsTheQuickestTransport) {
  const StampedSignal signal = signalOf(500, 0, 0, 1);
  const SignalTiming timing = timingOf(signal);
  EXPECT_NEAR(timing.delay, kTransport, 1e-12);
  EXPECT_EQ(timing.age, signal.arrivals.back() - signal.stamps.back());
  EXPECT_EQ(timing.lost, 0);
}

TEST(SignalTiming, OfAnExperimentItTellsOffsetAndJitter) {
  constexpr double kSpread = 0.001;
  const ExperimentTiming timing = resample(recordingOf(kSpread), 0, {}).timing;
  EXPECT_NEAR(timing.clockOffset(), kOutputAhead, kSpread + 1e-9);
  EXPECT_NEAR(timing.output.jitter, kSpread, 1e-6);
  EXPECT_NEAR(timing.input.jitter, 0, 1e-6);
}

TEST(SignalTiming, WhatIsNotKnownIsNotMadeUp) {
  Recording recording = recordingOf(0);
  recording.output.arrivals.clear();
  recording.input.stamps = {10, 10.5, 10.6, 12.3};  // a command given by hand
  recording.input.values = {0, 1, 2, 3};
  recording.input.arrivals.assign(4, std::nan(""));
  const ExperimentTiming timing = resample(recording, 0, {}).timing;
  EXPECT_TRUE(std::isnan(timing.output.age));
  EXPECT_TRUE(std::isnan(timing.output.delay));
  EXPECT_TRUE(std::isnan(timing.input.delay));
  EXPECT_TRUE(std::isnan(timing.input.jitter));
  EXPECT_TRUE(std::isnan(timing.clockOffset()));
}

TEST(SignalTiming, LossesCountInTheExperimentThatLacksThem) {
  ExperimentOptions options;
  options.mode = ExperimentMode::service;
  ExperimentCutter cutter(options, {});
  const auto record = [&](double start) {
    cutter.begin(start);
    for (int k = 0; k < 50; ++k) {
      const double stamp = start + k * kPeriod;
      cutter.addInput(stamp, k % 3, {stamp + kTransport, k == 20 ? 4 : 0});
      cutter.addOutput(stamp, k % 5, {stamp + kTransport, start > 15 && k == 30 ? 2 : 0});
    }
    cutter.finish(start + 0.5);
  };
  record(10);
  record(20);
  cutter.flush();
  const auto recordings = cutter.takeFinished();
  ASSERT_EQ(recordings.size(), 2U);
  for (const auto& recording : recordings) EXPECT_EQ(timingOf(recording.input).lost, 4);
  EXPECT_EQ(timingOf(recordings[0].output).lost, 0);
  EXPECT_EQ(timingOf(recordings[1].output).lost, 2);
  EXPECT_NEAR(timingOf(recordings[1].output).delay, kTransport, 1e-12);
}

TEST(SequenceCounter, CountsForEachPublisher) {
  SequenceCounter counter;
  EXPECT_EQ(counter.missingBefore("/a", 7), 0) << "the first tells nothing";
  EXPECT_EQ(counter.missingBefore("/a", 8), 0);
  EXPECT_EQ(counter.missingBefore("/b", 100), 0);
  EXPECT_EQ(counter.missingBefore("/a", 11), 2);
  EXPECT_EQ(counter.missingBefore("/b", 102), 1);
  EXPECT_EQ(counter.missingBefore("/a", 0), 0) << "started again";
  EXPECT_EQ(counter.missingBefore("/a", 0), 0) << "does not number";
  EXPECT_EQ(counter.missingBefore("/a", 1), 0);
}

}  // namespace
}  // namespace uncertainty_identification
