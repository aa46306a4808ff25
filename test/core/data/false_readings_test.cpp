#include "data/false_readings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/mentions.h"
#include "support/recording_setup.h"
#include "uncertainty_identification/data/loaded_data.h"

namespace uncertainty_identification {
namespace {

using test::kNaN;
using test::random;
using test::recordingOf;

/// 400 values of a square wave between 150 and 400, these replaced.
std::vector<double> squareWave(const std::vector<std::pair<std::size_t, double>>& replaced) {
  std::vector<double> values;
  for (int k = 0; k < 400; ++k) values.push_back(k / 50 % 2 == 0 ? 150 : 400);
  for (const auto& [place, value] : replaced) values[place] = value;
  return values;
}

TEST(FalseReadings, AreSingleAndFarFromAllOthers) {
  using Places = std::vector<std::size_t>;
  const auto places = [](const std::vector<double>& values) { return falseReadings(values, 1000); };
  EXPECT_EQ(places(squareWave({{7, -1.07e8}})), Places{7});
  EXPECT_EQ(places(squareWave({{7, 1e38}, {398, -1e7}})), (Places{7, 398}));
  EXPECT_EQ(places(squareWave({})), Places{});
  EXPECT_EQ(places(squareWave({{7, 2e5}})), Places{}) << "800 times the range";
  EXPECT_EQ(places(squareWave({{7, 1e8}, {8, 1e8}})), Places{}) << "a pulse";
  EXPECT_EQ(places(squareWave({{7, 1e8}, {8, kNaN}, {9, 1e8}})), Places{}) << "a pulse";
  EXPECT_EQ(places(squareWave({{7, 1e8}, {77, 1e8}, {177, 1e8}})), Places{}) << "too many";
  EXPECT_EQ(places(squareWave({{399, 1e8}})), Places{}) << "may be a step";
  EXPECT_EQ(places(squareWave({{9, HUGE_VAL}, {40, -HUGE_VAL}})), Places{}) << "told by the checks";
  std::vector<double> impulse(400, 0.0);
  impulse[9] = 1e6;
  EXPECT_EQ(places(impulse), Places{}) << "the others do not change";
}

TEST(FalseReadings, HoldTheInputAndAreMissingOutputs) {
  Recording recording = recordingOf(random(0, 0.1, 100, 1), random(0, 0.1, 100, 2));
  recording.id = "run";
  LoadedData clean, data;
  addResampled(recording, 0, {}, clean);
  recording.input.values[40] = -1.07e8;
  recording.output.values[60] = -9999;
  addResampled(recording, 0, {}, data);
  const Experiment &experiment = data.experiments.at(0), &before = clean.experiments.at(0);
  EXPECT_EQ(experiment.u(40), before.u(39));
  EXPECT_EQ(experiment.u(41), before.u(41));
  EXPECT_FALSE(experiment.isValid(60));
  EXPECT_EQ(experiment.validSamples(), 99);
  EXPECT_TRUE(test::anyMentions(data.warnings, "2 single readings lie far beyond the range"));
  EXPECT_TRUE(test::anyMentions(data.warnings, " at 4 s, output -9999 at 6 s)"));
}

/// A blow of a hammer is an input, though the force is noise otherwise.
TEST(FalseReadings, ImpulsesOfTheInputAreNone) {
  StampedSignal input = random(0, 0.1, 400, 1), output = random(0, 0.1, 400, 2);
  input.values[40] = 3000;
  EXPECT_EQ(replaceFalseReadings(input.stamps, &input.values, output.stamps, &output.values), "");
  EXPECT_EQ(input.values[40], 3000);
}

}  // namespace
}  // namespace uncertainty_identification
