#include "inspection/signal_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "inspection/resolution.h"

namespace uncertainty_identification {
namespace {

constexpr double kRate = 100;  // [Hz]

/// A channel of one record with the values of a function of time [s].
template <class Function>
Channel sampledChannel(int samples, const Function& value) {
  Channel channel;
  channel.name = "x";
  channel.records.resize(1);
  for (int k = 0; k < samples; ++k) {
    channel.records.front().stamps.push_back(k / kRate);
    channel.records.front().values.push_back(value(k / kRate));
  }
  return channel;
}

TEST(SignalMeasures, OfSineHaveRangeAndBand) {
  const SignalMeasures found =
      measure(sampledChannel(2000, [](double t) { return 3 + 2 * std::sin(2 * M_PI * 1.5 * t); }));
  EXPECT_EQ(found.samples, 2000);
  EXPECT_NEAR(found.smallest, 1, 1e-3);
  EXPECT_NEAR(found.largest, 5, 1e-3);
  EXPECT_EQ(found.shape, SignalShape::continuous);
  EXPECT_EQ(found.resolution, 0);
  ASSERT_TRUE(found.band);
  EXPECT_NEAR(*found.band, 1.5, 0.2);
}

TEST(SignalMeasures, OfEncoderFindItsStep) {
  const double step = 2 * M_PI / 4096;
  const SignalMeasures found = measure(sampledChannel(4000, [step](double t) {
    return step * std::round(0.2 * std::sin(2 * M_PI * 0.1 * t) / step);
  }));
  EXPECT_NEAR(found.resolution, step, 1e-4 * step);
  EXPECT_EQ(found.shape, SignalShape::continuous) << "small steps of a sensor are no commands";
  EXPECT_GT(found.held, 0.4);
}

TEST(SignalMeasures, OfCommandsSeeLevels) {
  const SignalMeasures stairs =
      measure(sampledChannel(1000, [](double t) { return 2.5 * std::floor(std::fmod(t, 4)); }));
  EXPECT_EQ(stairs.shape, SignalShape::steps);
  EXPECT_EQ(stairs.levels, 4);
  EXPECT_NEAR(stairs.resolution, 2.5, 1e-12);
  const SignalMeasures relay =
      measure(sampledChannel(1000, [](double t) { return std::fmod(t, 1) < 0.5 ? -1 : 1; }));
  EXPECT_EQ(relay.shape, SignalShape::two_levels);
  EXPECT_EQ(measure(sampledChannel(50, [](double) { return 7; })).shape, SignalShape::constant);
}

TEST(SignalMeasures, OfClippedSignalSayWhereItStays) {
  const auto clipped = [](double t) { return std::min(0.8, std::sin(2 * M_PI * t)); };
  const SignalMeasures found = measure(sampledChannel(1000, clipped));
  EXPECT_TRUE(found.clipped);
  EXPECT_NEAR(found.at_largest, 0.2, 0.03);
  EXPECT_FALSE(
      measure(sampledChannel(1000, [](double t) { return std::sin(2 * M_PI * t); })).clipped);
  const auto at_rest = [](double t) { return std::max(0.0, t - 3); };
  EXPECT_FALSE(measure(sampledChannel(1000, at_rest)).clipped) << "rest is no limit";
}

TEST(SignalMeasures, OfNothingAreEmpty) {
  Channel empty;
  EXPECT_EQ(measure(empty).samples, 0);
  empty.records.resize(3);
  EXPECT_EQ(measure(empty).shape, SignalShape::constant);
}

TEST(Resolution, OfSinglePrecisionAndRandomValues) {
  std::vector<double> floats;
  for (int k = 0; k < 200; ++k)
    floats.push_back(static_cast<float>(0.1) * static_cast<float>(k % 50));
  EXPECT_NEAR(resolutionOf(levelsOf(floats)), 0.1, 1e-6);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> noise;
  for (int k = 0; k < 500; ++k) noise.push_back(normal(random));
  EXPECT_EQ(resolutionOf(levelsOf(noise)), 0);
  EXPECT_EQ(resolutionOf({1, 2}), 0);
}

}  // namespace
}  // namespace uncertainty_identification
