// One stamp out of order costs one sample, not an experiment.
#include <gtest/gtest.h>

#include <vector>

#include "data/stamp_gate.h"
#include "support/cutter_setup.h"
#include "support/error_message.h"
#include "support/mentions.h"
#include "uncertainty_identification/data/loaded_data.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using test::kStep;
using test::mentions;

struct Stamp {
  double stamp;
};

/// What the gate passes on of these stamps, at the end too.
std::vector<double> passed(const std::vector<double>& stamps, int* dropped = nullptr) {
  StampGate<Stamp> gate;
  std::vector<double> all;
  const auto take = [&all](const std::vector<Stamp>& samples) {
    for (const Stamp& sample : samples) all.push_back(sample.stamp);
  };
  for (const double stamp : stamps) take(gate.pass({stamp}));
  take(gate.rest());
  if (dropped != nullptr) *dropped = gate.takeDropped();
  return all;
}

/// 0, 0.1, ... with the stamps at these places replaced.
std::vector<double> stampsWith(int count, const std::vector<std::pair<int, double>>& replaced) {
  std::vector<double> stamps;
  for (int k = 0; k < count; ++k) stamps.push_back(0.1 * k);
  for (const auto& [place, stamp] : replaced) stamps[static_cast<std::size_t>(place)] = stamp;
  return stamps;
}

TEST(StrayStamps, AreDroppedWhereTheClockGoesOn) {
  for (const double stray : {0.0, 3.975, 2.5, -1.0, 1e6, 1000.0}) {
    int dropped = 0;
    const std::vector<double> stamps = passed(stampsWith(100, {{41, stray}}), &dropped);
    EXPECT_EQ(dropped, 1) << stray;
    std::vector<double> expected = stampsWith(100, {});
    expected.erase(expected.begin() + 41);
    EXPECT_EQ(stamps, expected) << stray;
  }
}

TEST(StrayStamps, ThreeInARowAreAClockOfTheirOwn) {
  const auto two = stampsWith(100, {{60, 0}, {61, 0.1}});
  EXPECT_EQ(passed(two).size(), 98u);
  for (const double start : {0.0, 1e6}) {
    const auto three = stampsWith(63, {{60, start}, {61, start + 0.1}, {62, start + 0.2}});
    EXPECT_EQ(passed(three), three) << "none is lost, whatever they mean";
  }
}

TEST(StrayStamps, MoreThanOneInTwentyArePassedOn) {
  std::vector<std::pair<int, double>> rare, frequent;
  for (int k = 20; k < 400; k += 25) rare.emplace_back(k, 0.0);
  for (int k = 20; k < 400; k += 5) frequent.emplace_back(k, 0.0);
  EXPECT_EQ(passed(stampsWith(400, rare)).size(), 400 - rare.size());
  EXPECT_GT(passed(stampsWith(400, frequent)).size(), 400 - frequent.size());
}

TEST(StrayStamps, TheLastSampleAfterASilenceIsKept) {
  EXPECT_EQ(passed(stampsWith(50, {{49, 500}})).back(), 500);
}

TEST(StrayStamps, AMarkerOfTheNewClockConfirmsTheReset) {
  StampGate<Stamp> gate;
  for (const double stamp : stampsWith(50, {})) gate.pass({stamp});
  EXPECT_TRUE(gate.pass({0}).empty());
  EXPECT_TRUE(gate.confirm(4.8).empty());
  EXPECT_EQ(gate.confirm(0.2).size(), 1u);
  EXPECT_EQ(gate.pass({0.1}).size(), 1u);
}

/// An experiment of two signals, each with a stray.
TEST(StrayStamps, DoNotRejectTheRunningExperiment) {
  for (const double stray : {0.0, 99.8, 1e6}) {
    ExperimentCutter cutter(test::mode(ExperimentMode::topic), {});
    cutter.addMarker(90, true, "run");
    test::feed(cutter, 90, 100);
    cutter.addInput(stray, 5);
    cutter.addOutput(stray, 6);
    test::feed(cutter, 100, 110);
    cutter.addMarker(110, false);
    test::feed(cutter, 110, 111);
    EXPECT_TRUE(cutter.takeRejected().empty()) << stray;
    EXPECT_EQ(cutter.clockResets(), 0);
    const auto finished = cutter.takeFinished();
    ASSERT_EQ(finished.size(), 1u) << stray;
    EXPECT_EQ(finished[0].stray_stamps, 2);
    EXPECT_EQ(finished[0].output.stamps.size(), 160u);
    test::expectSpan(finished[0].input, 90, 110 - kStep);
  }
}

TEST(StrayStamps, AreCountedInAWarning) {
  for (const double stray : {0.0, 3.0, 1e6}) {
    Recording recording;
    recording.id = "run";
    recording.stray_stamps = 1;
    recording.input.stamps = recording.output.stamps = stampsWith(100, {{41, stray}});
    for (int k = 0; k < 100; ++k) {
      recording.input.values.push_back(k % 7);
      recording.output.values.push_back(k % 11);
    }
    LoadedData data;
    addResampled(recording, 0, {}, data);
    ASSERT_EQ(data.experiments.size(), 1u)
        << (data.rejected.empty() ? "" : data.rejected.front().reason);
    EXPECT_EQ(data.experiments[0].samples(), 100);
    EXPECT_TRUE(test::anyMentions(data.warnings, "experiment 'run': 3 samples are left out, whose"))
        << stray;
  }
}

}  // namespace
}  // namespace uncertainty_identification
