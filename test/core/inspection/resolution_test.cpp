#include "inspection/resolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace uncertainty_identification {
namespace {

using Levels = std::vector<double>;

/// As a logger prints a value with this many decimals.
double printedWith(int decimals, double value) {
  const double scale = std::pow(10, decimals);
  return std::round(value * scale) / scale;
}

TEST(Levels, AreTheDifferentValuesInRisingOrder) {
  EXPECT_EQ(levelsOf({3, -1, 3, 2, -1}), (Levels{-1, 2, 3}));
  EXPECT_EQ(levelsOf({4, 4, 4}), (Levels{4}));
  EXPECT_TRUE(levelsOf({}).empty());
}

TEST(Levels, CountValuesOnceThatDifferByTheRoundingOfSinglePrecision) {
  EXPECT_EQ(levelsOf({0.1, static_cast<float>(0.1), 0.2}).size(), 2u);
  EXPECT_EQ(levelsOf({-1000, -1000.0001, 0}).size(), 2u) << "of the largest, whatever its sign";
  EXPECT_EQ(levelsOf({0.1, 0.1001, 0.2}).size(), 3u);
}

TEST(Levels, OfACounterOfMillionsAreAllItsCounts) {
  std::vector<double> counts(4000000);
  for (std::size_t k = 0; k < counts.size(); ++k) counts[k] = static_cast<double>(k);
  const Levels levels = levelsOf(counts);
  EXPECT_EQ(levels.size(), counts.size());
  EXPECT_DOUBLE_EQ(resolutionOf(levels), 1);
  for (double& count : counts) count *= 1e-3;  // as a time in seconds
  EXPECT_NEAR(resolutionOf(levelsOf(counts)), 1e-3, 1e-9);
}

TEST(Levels, OfNoiseOnALargeOffsetHaveNoResolution) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(101320, 101330);
  std::vector<double> pressures(200000);
  for (double& pressure : pressures) pressure = uniform(random);
  EXPECT_EQ(resolutionOf(levelsOf(pressures)), 0);
}

TEST(Resolution, OfALatticeIsItsStepWhereverItStarts) {
  EXPECT_DOUBLE_EQ(resolutionOf({0, 0.25, 0.5, 0.75}), 0.25);
  EXPECT_NEAR(resolutionOf({273.15, 273.65, 274.15, 275.65}), 0.5, 1e-9);
}

TEST(Resolution, IsSeenThoughLevelsOfTheLatticeAreLeftOut) {
  EXPECT_DOUBLE_EQ(resolutionOf({-10, -4, -2, 0, 8, 14}), 2);
  EXPECT_DOUBLE_EQ(resolutionOf({0, 1, 1.5}), 0.5) << "the smallest difference";
}

TEST(Resolution, OfPrintedDecimalsIsTheLastDigit) {
  std::vector<double> values;
  for (int k = 0; k < 300; ++k) values.push_back(printedWith(1, 20 + 3 * std::sin(0.1 * k)));
  EXPECT_NEAR(resolutionOf(levelsOf(values)), 0.1, 1e-9);
}

TEST(Resolution, OfAConverterIsSeenThroughTheRoundingOfItsPrint) {
  const double step = 5.0 / 4096;  // [V] of 12 bits, which four decimals make 1.2 or 1.3 mV
  std::vector<double> values;
  for (int count = 0; count < 400; ++count) values.push_back(printedWith(4, step * count));
  EXPECT_NEAR(resolutionOf(levelsOf(values)), step, 1e-6);
}

TEST(Resolution, NeedsThreeLevels) {
  EXPECT_EQ(resolutionOf({}), 0);
  EXPECT_EQ(resolutionOf({7}), 0);
  EXPECT_EQ(resolutionOf({-1, 1}), 0) << "a relay says nothing about its sensor";
  EXPECT_EQ(resolutionOf({-1, 0, 1}), 1);
}

TEST(Resolution, IsNoneWhereDifferencesAreNoMultiples) {
  EXPECT_EQ(resolutionOf({0, 1, 2.618}), 0);
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> values;
  for (int k = 0; k < 2000; ++k) values.push_back(uniform(random));
  EXPECT_EQ(resolutionOf(levelsOf(values)), 0);
}

TEST(Resolution, IsNoneWhereTheSmallestDifferenceIsFarBelowTheUsualOne) {
  EXPECT_EQ(resolutionOf({0, 0.01, 1.01, 2.01, 3.01}), 0)
      << "any difference is nearly a multiple of a hundredth of it";
}

TEST(Resolution, PassesOverAFewLevelsBesideTheLattice) {
  Levels saturated;
  for (int k = 0; k < 100; ++k) saturated.push_back(k);
  saturated.push_back(100.4);
  EXPECT_NEAR(resolutionOf(saturated), 1, 1e-12) << "its limit lies beside the lattice";
  EXPECT_EQ(resolutionOf({0, 1, 2, 3, 4, 5, 6, 7.4, 8.8, 10.2}), 0) << "a third of them do";
}

}  // namespace
}  // namespace uncertainty_identification
