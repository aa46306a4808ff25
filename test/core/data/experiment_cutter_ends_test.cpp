// How an experiment ends: windows of a duration, gaps, clocks that go back, limits.
#include <gtest/gtest.h>

#include "data/experiment_cutter.h"
#include "support/cutter_setup.h"
#include "support/mentions.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using test::expectSpan;
using test::feed;
using test::kStep;
using test::limit;
using test::mentions;
using test::mode;

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
  cutter.releaseClosed();
  EXPECT_EQ(cutter.takeFinished().size(), 1u);
  EXPECT_TRUE(cutter.takeRejected().empty());
}

// Topics are not ordered among each other: a looped bag's marker and input can be ahead of its
// output.
TEST(Cutter, ClosedExperimentsStillTakeStampsOfTheOldClock) {
  ExperimentCutter cutter(mode(ExperimentMode::topic), {});
  cutter.addMarker(0, true, "late");
  feed(cutter, 0, 1.5);
  cutter.addInput(1.5, 0);
  cutter.addInput(1.75, 0);
  cutter.addMarker(2, false);
  for (const double stamp : {0.0, 0.25, 0.5}) cutter.addInput(stamp, 0);  // the next pass begins
  EXPECT_TRUE(cutter.takeFinished().empty());
  EXPECT_TRUE(cutter.waiting());
  cutter.addOutput(1.5, 0);
  cutter.addOutput(1.75, 0);
  EXPECT_TRUE(cutter.takeFinished().empty()) << "the output may still bring more";
  for (const double stamp : {0.0, 0.25, 0.5}) cutter.addOutput(stamp, 0);
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 1u);
  expectSpan(finished[0].input, 0, 1.75);
  expectSpan(finished[0].output, 0, 1.75);
  EXPECT_FALSE(cutter.waiting());
  EXPECT_EQ(cutter.dropped(), 0);
  EXPECT_EQ(cutter.clockResets(), 1);
}

/// An experiment from 0 to 2 s whose signals have begun the next pass before its marker fell.
ExperimentCutter signalsAheadOfTheMarker() {
  ExperimentCutter cutter(mode(ExperimentMode::topic), {});
  cutter.addMarker(0, true, "late");
  feed(cutter, 0, 2);
  feed(cutter, 0, 0.75);
  return cutter;
}

TEST(Cutter, AMarkerOfTheOldClockStillEndsItsExperiment) {
  ExperimentCutter cutter = signalsAheadOfTheMarker();
  EXPECT_FALSE(cutter.running());
  EXPECT_TRUE(cutter.waiting());
  EXPECT_TRUE(cutter.takeRejected().empty()) << "its end may still come";
  cutter.addMarker(2, false);
  const auto finished = cutter.takeFinished();
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].id, "late");
  expectSpan(finished[0].output, 0, 2 - kStep);
  cutter.addMarker(0, true, "next");
  feed(cutter, 0.75, 2);
  cutter.addMarker(2, false);
  cutter.flush();
  ASSERT_EQ(cutter.takeFinished().size(), 1u);
  EXPECT_TRUE(cutter.takeRejected().empty());
  EXPECT_EQ(cutter.clockResets(), 1);
}

TEST(Cutter, TheRunningExperimentIsRejectedWhereNoMarkerOfTheOldClockComes) {
  ExperimentCutter by_marker = signalsAheadOfTheMarker();
  by_marker.addMarker(0, true, "next");
  EXPECT_EQ(by_marker.takeRejected().size(), 1u);
  EXPECT_TRUE(by_marker.running()) << "the next one";
  ExperimentCutter halfway = signalsAheadOfTheMarker();
  feed(halfway, 0.75, 1.5);
  EXPECT_EQ(halfway.takeRejected().size(), 1u);
  ExperimentCutter silent = signalsAheadOfTheMarker();
  silent.releaseClosed();
  const auto rejected = silent.takeRejected();
  ASSERT_EQ(rejected.size(), 1u);
  EXPECT_TRUE(mentions(rejected[0].reason, "experiment 'late': the clock went back"));
}

TEST(Cutter, StampsOfTheOldClockAreLeftOutAfterAReset) {
  ExperimentCutter cutter(mode(ExperimentMode::topic), {});
  feed(cutter, 100, 110);
  for (const double stamp : {0.0, 0.03125, 0.0625})
    cutter.addOutput(stamp, 7);  // the output is reset first
  cutter.addInput(110, -1);      // while inputs of the old clock are still on their way
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
  for (const double stamp : {1.25, 1.375, 1.5}) cutter.addOutput(stamp, 0);  // unordered
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
