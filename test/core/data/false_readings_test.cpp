#include "data/false_readings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/mentions.h"
#include "support/recording_setup.h"

namespace uncertainty_identification {
namespace {

using test::random;
using test::recordingOf;

/// 400 values of a square wave between 150 and 400, these replaced.
std::vector<double> squareWave(const std::vector<std::pair<std::size_t, double>>& replaced) {
  std::vector<double> values;
  for (int k = 0; k < 400; ++k) values.push_back(k / 50 % 2 == 0 ? 150 : 400);
  for (const auto& [place, value] : replaced) values[place] = value;
  return values;
}

TEST(FalseReadings, AreSingleAndAThousandTimesAsFarOff) {
  using Places = std::vector<std::size_t>;
  EXPECT_EQ(falseReadings(squareWave({{7, -1.07e8}})), Places{7});
  EXPECT_EQ(falseReadings(squareWave({{0, 1e38}, {399, -1e7}})), (Places{0, 399}));
  EXPECT_EQ(falseReadings(squareWave({})), Places{});
  EXPECT_EQ(falseReadings(squareWave({{7, 2e5}})), Places{}) << "800 times the range";
  EXPECT_EQ(falseReadings(squareWave({{7, 1e8}, {8, 1e8}})), Places{}) << "a pulse";
  EXPECT_EQ(falseReadings(squareWave({{7, 1e8}, {77, 1e8}, {177, 1e8}})), Places{}) << "too many";
  std::vector<double> impulse(400, 0.0);
  impulse[9] = 1e6;
  EXPECT_EQ(falseReadings(impulse), Places{}) << "the others do not change";
}

TEST(FalseReadings, HoldTheInputAndAreMissingOutputs) {
  Recording recording = recordingOf(random(0, 0.1, 100, 1), random(0, 0.1, 100, 2));
  const Recording clean = recording;
  recording.input.values[40] = -1.07e8;
  recording.output.values[60] = -9999;
  ResamplingReport report;
  const Experiment experiment = resample(recording, 0, {}, &report),
                   before = resample(clean, 0, {});
  EXPECT_EQ(experiment.u(40), before.u(39));
  EXPECT_EQ(experiment.u(41), before.u(41));
  EXPECT_FALSE(experiment.isValid(60));
  EXPECT_EQ(experiment.validSamples(), 99);
  const std::vector<std::string> warnings = report.warnings();
  ASSERT_FALSE(warnings.empty());
  EXPECT_TRUE(test::mentions(warnings[0], "2 single readings")) << warnings[0];
  EXPECT_TRUE(test::mentions(warnings[0], "the input is -1.07e+08 at 4 s")) << warnings[0];
}

}  // namespace
}  // namespace uncertainty_identification
