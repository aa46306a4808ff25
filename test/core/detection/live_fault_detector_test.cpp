// Stamped signals in pieces against the same samples given one by one. Data: Example 1, simulated.
#include "detection/live_fault_detector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/faults.h"
#include "support/monte_carlo.h"

namespace uncertainty_identification {
namespace {

using test::decisions;
using test::estimateOf;
using test::Fault;
using test::FaultKind;
using test::FaultyPlant;

constexpr double kSampleTime = 0.01;  // [s], of config/example1_truth.yaml
constexpr double kBegin = 1000;       // [s]

Experiment experimentWith(const Fault& fault, int samples = 600) {
  return FaultyPlant(test::example1Truth(1, samples), 4).experiment(0, fault);
}

/// What a recorder cuts of the experiment: samples `first` to `last` - 1, each with this stamp
/// error.
Recording piece(const Experiment& experiment, int first, int last, double jitter = 0) {
  std::mt19937_64 random(static_cast<std::uint64_t>(first));
  std::uniform_real_distribution<double> departure(-jitter, jitter);
  const double period = experiment.sample_time;
  Recording recording;
  recording.id = "piece";
  for (int t = first; t < last; ++t) {
    const double due = kBegin + t * period;
    recording.input.stamps.push_back(due + departure(random));
    recording.input.values.push_back(experiment.u[t]);
    if (!experiment.isValid(t)) continue;
    recording.output.stamps.push_back(due + departure(random));
    recording.output.values.push_back(experiment.y[t]);
  }
  return recording;
}

std::vector<StampedFaultWindow> inPieces(LiveFaultDetector* live, const Experiment& experiment,
                                         int samples, double jitter = 0) {
  std::vector<StampedFaultWindow> all;
  for (int first = 0; first < experiment.samples(); first += samples) {
    const int last = std::min(first + samples, experiment.samples());
    for (const auto& window : live->add(piece(experiment, first, last, jitter)))
      all.push_back(window);
  }
  return all;
}

void expectTheSame(const std::vector<StampedFaultWindow>& found,
                   const std::vector<FaultWindow>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_NEAR(found[k].window.statistic, expected[k].statistic, 1e-9);
    EXPECT_EQ(found[k].window.fault, expected[k].fault);
    EXPECT_NEAR(found[k].start, kBegin + static_cast<double>(expected[k].first) * kSampleTime,
                1e-3);
    EXPECT_NEAR(found[k].end, kBegin + static_cast<double>(expected[k].last) * kSampleTime, 1e-3);
  }
}

class Pieces : public testing::TestWithParam<double> {};

TEST_P(Pieces, GiveWhatTheSamplesGive) {
  const Experiment experiment = experimentWith({FaultKind::bias, 1.0, 300});
  LiveFaultDetector live(estimateOf(test::example1Truth()), {});
  EXPECT_NEAR(live.pieceDuration(), 10 * kSampleTime, 1e-12);
  FaultDetector plain(estimateOf(test::example1Truth()));
  expectTheSame(inPieces(&live, experiment, 20, GetParam()), decisions(&plain, experiment));
}

INSTANTIATE_TEST_SUITE_P(Jitter, Pieces, testing::Values(0.0, 0.05 * kSampleTime));

TEST(LiveFaultDetector, OutputsMissingBetweenPiecesAreBridgedWithWhatWasCommanded) {
  Experiment experiment = experimentWith({});
  experiment.valid.assign(600, 1);
  for (int t = 96; t < 105; ++t) experiment.valid[static_cast<std::size_t>(t)] = 0;
  FaultDetectionConfiguration configuration;
  configuration.resampling.max_age = 0.5 * kSampleTime;  // a missing output is missing at once
  LiveFaultDetector strict(estimateOf(test::example1Truth()), configuration);
  FaultDetector plain(estimateOf(test::example1Truth()));
  expectTheSame(inPieces(&strict, experiment, 20), decisions(&plain, experiment));
}

/// Sampled this much faster: the inputs average to those of the experiment, and of the outputs only
/// the first of each is its own.
Experiment faster(const Experiment& experiment, int times) {
  Experiment fast = experiment;
  fast.sample_time /= times;
  fast.u.resize(experiment.samples() * times);
  fast.y.resize(fast.u.size());
  for (int t = 0; t < fast.samples(); ++t) {
    fast.u[t] = experiment.u[t / times] + (t % 2 == 0 ? 0.5 : -0.5);
    fast.y[t] = experiment.y[t / times] + (t % times == 0 ? 0 : 9);
  }
  return fast;
}

TEST(LiveFaultDetector, TakesSamplesTogetherAsTheModelWasFitted) {
  constexpr int kTimes = 4;
  const Experiment experiment = experimentWith({FaultKind::bias, 1.0, 300});
  Estimate estimate = estimateOf(test::example1Truth());
  FaultDetector plain(estimate);
  estimate.configuration.estimation.thinning = kTimes;
  LiveFaultDetector live(estimate, {});
  EXPECT_NEAR(live.pieceDuration(), 10 * kSampleTime, 1e-12);
  expectTheSame(inPieces(&live, faster(experiment, kTimes), 30), decisions(&plain, experiment));
}

TEST(LiveFaultDetector, ALongSilenceBeginsAnew) {
  const Experiment experiment = experimentWith({});
  LiveFaultDetector live(estimateOf(test::example1Truth()), {});
  live.add(piece(experiment, 0, 30));
  const auto found = live.add(piece(experiment, 200, 250));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].window.first, 0) << "counted from the silence on";
  EXPECT_NEAR(found[0].start, kBegin + 200 * kSampleTime, 1e-9);
}

TEST(LiveFaultDetector, AClockThatGoesBackBeginsAnew) {
  const Experiment experiment = experimentWith({});
  LiveFaultDetector live(estimateOf(test::example1Truth()), {});
  live.add(piece(experiment, 300, 340));
  const auto found = live.add(piece(experiment, 0, 50));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].window.first, 0);
}

TEST(LiveFaultDetector, MarkersBeginAndEndExperiments) {
  const Experiment experiment = experimentWith({});
  FaultDetectionConfiguration configuration;
  configuration.experiment_topic = "active";
  LiveFaultDetector live(estimateOf(test::example1Truth()), configuration);
  EXPECT_FALSE(live.active());
  EXPECT_TRUE(live.add(piece(experiment, 0, 100)).empty());
  live.addMarker(kBegin + 1.05, true);
  live.addMarker(kBegin + 2.50, false);
  live.addMarker(kBegin + 3.00, true);
  live.addMarker(kBegin + 3.55, false);
  const auto found = inPieces(&live, experiment, 20);
  ASSERT_EQ(found.size(), 3u);  // of 145 and of 55 samples
  EXPECT_NEAR(found[0].start, kBegin + 1.05, 1e-9);
  EXPECT_NEAR(found[1].end, kBegin + 2.04, 1e-9);
  EXPECT_NEAR(found[2].start, kBegin + 3.00, 1e-9) << "the 45 samples before are forgotten";
  EXPECT_FALSE(live.active());
}

// A result may arrive while the markers of the next experiment are there already, and its samples
// are not.
TEST(LiveFaultDetector, MarkersStayWhenANewResultIsAdopted) {
  const Experiment experiment = experimentWith({});
  FaultDetectionConfiguration configuration;
  configuration.experiment_topic = "active";
  LiveFaultDetector live(estimateOf(test::example1Truth()), configuration);
  live.addMarker(kBegin, true);
  live.addMarker(kBegin + 2.05, false);
  live.adopt(estimateOf(test::example1Truth()));
  const auto found = inPieces(&live, experiment, 20);
  ASSERT_EQ(found.size(), 4u) << "of 50 samples each";
  EXPECT_NEAR(found[0].start, kBegin, 1e-9);
}

TEST(LiveFaultDetector, ANewResultBeginsANewWindow) {
  const Experiment experiment = experimentWith({});
  LiveFaultDetector live(estimateOf(test::example1Truth()), {});
  live.add(piece(experiment, 0, 30));
  live.adopt(estimateOf(test::example1Truth()));
  const auto found = live.add(piece(experiment, 30, 90));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].start, kBegin + 0.30, 1e-9);
}

}  // namespace
}  // namespace uncertainty_identification
