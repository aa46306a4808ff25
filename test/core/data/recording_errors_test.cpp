// What resampling refuses, and what it leaves out and counts.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/mentions.h"
#include "support/recording_setup.h"
#include "uncertainty_identification/data/recording.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using test::kNaN;
using test::mentions;
using test::messageOf;
using test::ramp;
using test::recordingOf;

TEST(Resample, DuplicateStampsAreLeftOutAndCounted) {
  StampedSignal output = ramp(0, 1, 30, 0);
  output.stamps.insert(output.stamps.begin() + 5, 5);
  output.values.insert(output.values.begin() + 5, 5);
  output.stamps.insert(output.stamps.begin() + 6, 5);
  output.values.insert(output.values.begin() + 6, -1);
  ResamplingReport report;
  const Experiment experiment = resample(recordingOf(ramp(0, 1, 30, 0), output), 1, {}, &report);
  EXPECT_EQ(experiment.samples(), 30);
  EXPECT_EQ(experiment.y(5), 5);
  EXPECT_EQ(report.duplicate_stamps, 2);
  ASSERT_EQ(report.warnings().size(), 1u);
  EXPECT_TRUE(mentions(report.warnings()[0], "'run': 2 samples have the same stamp"));
}

TEST(Resample, OfInputsWithOneStampTheLastIsInForce) {
  const StampedSignal input{{0, 2, 2, 4}, {0, 1, 9, 5}};
  const Experiment experiment = resample(recordingOf(input, ramp(0, 1, 5, 0)), 1, {});
  EXPECT_EQ(experiment.u, (Eigen::VectorXd(5) << 0, 0, 9, 9, 5).finished());
}

TEST(Resample, BackwardStampsAreRefused) {
  StampedSignal output = ramp(0, 1, 30, 0);
  for (std::size_t k = 12; k < 15; ++k) output.stamps[k] = static_cast<double>(k) - 9;
  const std::string message = messageOf(recordingOf(ramp(0, 1, 30, 0), output), 1);
  EXPECT_TRUE(
      mentions(message, "experiment 'run': output stamps go back from 11 s to 3 s at sample 12"))
      << message;
}

TEST(Resample, NonFiniteStampsAreRefused) {
  StampedSignal input = ramp(0, 1, 30, 0);
  input.stamps[2] = kNaN;
  EXPECT_TRUE(mentions(messageOf(recordingOf(input, ramp(0, 1, 30, 0)), 1),
                       "input has the stamp nan s at sample 2"));
}

TEST(Resample, UnequalNumbersOfStampsAndValuesAreRefused) {
  StampedSignal input = ramp(0, 1, 30, 0);
  input.values.pop_back();
  EXPECT_TRUE(
      mentions(messageOf(recordingOf(input, ramp(0, 1, 30, 0)), 1), "30 stamps for 29 values"));
}

TEST(Resample, EmptySignalsAreRefused) {
  EXPECT_TRUE(
      mentions(messageOf(recordingOf({}, ramp(0, 1, 9, 0)), 1), "'run': input has no samples"));
  EXPECT_TRUE(
      mentions(messageOf(recordingOf(ramp(0, 1, 9, 0), {}), 1), "'run': output has no samples"));
}

TEST(Resample, OneStampGivesNoSampleTime) {
  const Recording recording = recordingOf(ramp(0, 1, 9, 0), {{0, 0, 0}, {1, 2, 3}});
  EXPECT_TRUE(mentions(messageOf(recording, 0), "single stamp (0 s, 2 duplicates)"));
  EXPECT_EQ(resample(recording, 1, {}).samples(), 1);
}

TEST(Resample, DisjointSignalsAreRefused) {
  const std::string message = messageOf(recordingOf(ramp(100, 1, 9, 0), ramp(0, 1, 9, 0)), 1);
  EXPECT_TRUE(mentions(message, "the last output (8 s) precedes the first input (100 s)"))
      << message;
}

TEST(Resample, JitterAboveTheLimitIsRefused) {
  StampedSignal output = ramp(0, 1, 30, 0);
  output.stamps[10] += 0.2;
  ResamplingOptions options;
  options.max_jitter = 0.1;
  const std::string message = messageOf(recordingOf(ramp(0, 1, 30, 0), output), 1, options);
  EXPECT_TRUE(mentions(message, "deviate by up to 0.2 s")) << message;
  options.max_jitter = 0.3;
  EXPECT_EQ(messageOf(recordingOf(ramp(0, 1, 30, 0), output), 1, options), "");
}

TEST(Resample, OldInputEndsTheExperimentAtItsEdgesAndIsRefusedInBetween) {
  ResamplingOptions options;
  options.max_age = 3;
  StampedSignal input = ramp(-10, 1, 1, 0);
  const StampedSignal later = ramp(4, 1, 17, 4);  // up to 20 s
  input.stamps.insert(input.stamps.end(), later.stamps.begin(), later.stamps.end());
  input.values.insert(input.values.end(), later.values.begin(), later.values.end());
  const Experiment experiment = resample(recordingOf(input, ramp(0, 1, 30, 0)), 1, options);
  EXPECT_EQ(experiment.start_time, 4);
  EXPECT_EQ(experiment.samples(), 20);  // 4 s to 23 s
  EXPECT_EQ(experiment.y(0), 4);

  input.stamps.push_back(28);
  input.values.push_back(0);
  const std::string message = messageOf(recordingOf(input, ramp(0, 1, 30, 0)), 1, options);
  EXPECT_TRUE(mentions(message, "the input is 4 s old at 24 s")) << message;

  options.max_age = 0;  // a command published once is held for good, and its age told
  ResamplingReport report;
  resample(recordingOf(input, ramp(0, 1, 30, 0)), 1, options, &report);
  EXPECT_EQ(report.max_age, 13);
}

TEST(Resample, StampsFarApartAreRefusedBeforeTheyFillTheMemory) {
  StampedSignal output = ramp(1.7e9, 0.01, 100, 0);
  output.stamps[0] = 0;
  const std::string message = messageOf(recordingOf(ramp(0, 0.01, 100, 0), output), 0.01);
  EXPECT_TRUE(mentions(message, "(1 stamped 0)")) << message;
}

TEST(Resample, LostSamplesDoNotDisturbTheGrid) {
  std::mt19937_64 engine(6);
  std::uniform_real_distribution<double> uniform(0, 1);
  StampedSignal output;
  for (int k = 0; k < 3000; ++k) {
    if (k > 0 && k < 2999 && uniform(engine) < 0.3) continue;
    output.stamps.push_back(50 + 0.02 * k + 0.004 * uniform(engine));
    output.values.push_back(k);
  }
  ResamplingOptions options;
  ResamplingReport report;
  StampedSignal input = ramp(50, 0.02, 3000, 0);
  options.max_age = 0.01;  // half a sample time: nothing is held
  const Experiment experiment = resample(recordingOf(input, output), 0, options, &report);
  EXPECT_EQ(experiment.sample_time, 0.02);
  ASSERT_EQ(experiment.samples(), 3000);
  EXPECT_EQ(experiment.validSamples(), static_cast<int>(output.stamps.size()));
  for (int k = 0; k < 3000; ++k) {
    if (experiment.isValid(k)) {
      ASSERT_EQ(experiment.y(k), k);
    }
  }
}

}  // namespace
}  // namespace uncertainty_identification
