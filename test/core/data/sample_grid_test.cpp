#include "data/sample_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace uncertainty_identification {
namespace {

TEST(SampleGrid, FindsPeriodAndSlotsUnderJitterAndLoss) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double start : {0.0, 1.7e9}) {
    for (const double jitter : {0.0, 1e-4, 0.05, 0.15}) {
      std::vector<double> stamps;
      std::vector<long> slots;
      for (int k = 0; k < 2000; ++k) {
        if (k > 0 && uniform(engine) < 0.1) continue;
        stamps.push_back(start + 0.01 * (k + jitter * (2 * uniform(engine) - 1)));
        slots.push_back(k);
      }
      const SampleGrid grid = fitSampleGrid(stamps);
      EXPECT_TRUE(grid.one_to_one) << start << " " << jitter;
      EXPECT_EQ(grid.period, 0.01);
      EXPECT_EQ(grid.slots, slots);
      EXPECT_NEAR(grid.max_departure, 0.01 * jitter, 0.002 * jitter + 1e-6);
    }
  }
}

TEST(SampleGrid, ExactStampsGiveTheirPeriodToTheLastBit) {
  for (const double period : {1.0 / 3, 0.1, 1.0 / 30, 0.0123456789012345678}) {
    std::vector<double> stamps;
    for (int k = 0; k < 1000; ++k) stamps.push_back(k * period);
    EXPECT_EQ(fitSampleGrid(stamps).period, period);
    EXPECT_EQ(fitSampleGrid(stamps).origin, 0);
  }
}

TEST(SampleGrid, StampsRoundedToAboutAPeriodLoseNoRow) {
  for (const double start : {0.0, 1.7e9}) {
    for (const double period : {1.05e-3, 1.2e-3, 1.37e-3, 1.45e-3}) {
      std::vector<double> stamps;
      for (int k = 0; k < 500; ++k)
        stamps.push_back(start + std::floor(0.4 + k * period / 1e-3) * 1e-3);
      const SampleGrid grid = fitSampleGrid(stamps);
      EXPECT_TRUE(grid.one_to_one) << start << " " << period;
      EXPECT_EQ(grid.slots.back(), 499) << start << " " << period;
      EXPECT_NEAR(grid.period, period, 2e-3 / 499);
    }
  }
}

/// A logger that reads a clock of whole seconds every two seconds and is late once.
TEST(SampleGrid, OneOddStepChangesNoPeriod) {
  std::vector<double> stamps;
  for (int k = 0; k < 441; ++k) stamps.push_back(2.0 * k + (k > 156 ? 1 : 0));
  EXPECT_EQ(fitSampleGrid(stamps).period, 2.0);
}

TEST(SampleGrid, RowsLostRegularlyStayLost) {
  for (const auto& [period, each] : {std::pair{0.11, 10}, std::pair{0.01, 50}}) {
    std::vector<double> stamps;
    for (int k = 0; k < 1000; ++k)
      if (k % each != 5) stamps.push_back(k * period);
    EXPECT_EQ(fitSampleGrid(stamps).slots.back(), 999) << period;
  }
}

TEST(SampleGrid, RowsLostAtRandomStayLost) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int run = 0; run < 200; ++run) {
    std::vector<double> stamps{0};
    for (long k = 1, lost = 0; lost < 8; ++k)
      uniform(engine) < 0.1 ? ++lost : (stamps.push_back(1e-3 * static_cast<double>(k)), 0);
    EXPECT_EQ(fitSampleGrid(stamps).period, 1e-3) << run;
  }
}

TEST(SampleGrid, EventsFollowNoGrid) {
  std::mt19937_64 engine(2);
  std::exponential_distribution<double> wait(1.0);
  std::vector<double> stamps{0};
  while (stamps.size() < 500) stamps.push_back(stamps.back() + wait(engine));
  const SampleGrid grid = fitSampleGrid(stamps);
  EXPECT_FALSE(grid.one_to_one);
  EXPECT_NEAR(grid.period, std::log(2.0), 0.15);  // the median spacing
}

TEST(SampleGrid, ToleranceCoversWhatADoubleResolves) {
  EXPECT_DOUBLE_EQ(stampTolerance(0, 0.01), 1e-8);
  EXPECT_DOUBLE_EQ(stampTolerance(-5, 100), 1e-4);
  EXPECT_GT(stampTolerance(1.7e9, 0.01), 2.4e-7);  // the spacing of doubles there
  EXPECT_LT(stampTolerance(1.7e9, 0.01), 2e-6);
}

TEST(SampleGrid, SurvivesAbsurdStamps) {
  EXPECT_EQ(fitSampleGrid({}).period, 0);
  EXPECT_EQ(fitSampleGrid({5}).period, 0);
  EXPECT_EQ(fitSampleGrid({5}).origin, 5);
  EXPECT_EQ(fitSampleGrid({5, 7}).period, 2);
  EXPECT_GT(fitSampleGrid({0, 1e-300, 1e300}).period, 0);
  EXPECT_GT(fitSampleGrid({0, 1e-9, 2e-9, 1.7e9}).period, 0);
  EXPECT_GT(fitSampleGrid({-1e308, 0, 1e308}).period, 0);
}

}  // namespace
}  // namespace uncertainty_identification
