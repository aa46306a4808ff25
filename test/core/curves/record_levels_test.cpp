// Records whose sensor has another zero point in each. Data: a slow plant behind an actuator of
// limited rate.
#include "curves/record_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "curves/explain_simulation.h"
#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

constexpr int kFitted = 6, kHeldRecords = 2;

double levelOf(int record) { return 3 * std::sin(2.0 * record + 1); }

/// Records of two lags, whose input moves by `rate` a sample at most, counted from `height` times
/// their level.
std::vector<Experiment> recordsOf(double rate, double height) {
  constexpr int kSamples = 250;
  std::vector<Experiment> all(kFitted + kHeldRecords);
  for (int r = 0; r < kFitted + kHeldRecords; ++r) {
    std::mt19937_64 engine(static_cast<unsigned>(r) + 31);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(-1, 1);
    Experiment& each = all[static_cast<std::size_t>(r)];
    each.id = "run " + std::to_string(r);
    each.sample_time = 0.05;
    each.u.resize(kSamples);
    each.y.resize(kSamples);
    double actuator = 0, inner = 0, outer = 0;
    for (int k = 0; k < kSamples; ++k) {
      each.u[k] = k % 17 == 0 ? uniform(engine) : each.u[k - 1];
      each.y[k] = outer + height * levelOf(r) + 0.01 * normal(engine);
      actuator += std::min(std::max(each.u[k] - actuator, -rate), rate);
      outer += 0.07 * (inner - outer);
      inner += 0.025 * (2 * actuator - inner);
    }
  }
  return all;
}

struct Parts {
  std::vector<Experiment> fitted, held;
};

Parts partsOf(const std::vector<Experiment>& all) {
  return {{all.begin(), all.begin() + kFitted}, {all.begin() + kFitted, all.end()}};
}

std::optional<LevelledRecords> levelled(const std::vector<Experiment>& all, bool holds_out = true) {
  WorkerPool pool(1);
  CurveSearchContext context;
  context.pool = &pool;
  context.going_on = [] { return true; };
  Parts parts = partsOf(all);
  if (!holds_out) parts = {all, {}};
  return countedFromOwnLevels(parts.fitted, parts.held, planWindows(parts.fitted), context);
}

/// Relative to the first, which the common bias takes up.
double largestError(const LevelledRecords& records) {
  std::vector<double> levels = records.fitted_levels;
  levels.insert(levels.end(), records.held_levels.begin(), records.held_levels.end());
  double largest = 0;
  for (int r = 0; r < kFitted + kHeldRecords; ++r)
    largest = std::max(largest, std::abs(levels[static_cast<std::size_t>(r)] - levels[0] -
                                         (levelOf(r) - levelOf(0))));
  return largest;
}

/// Without a limit the plant is linear, and the levels are as exact as the noise of 250 samples
/// and a slow pole let them be: within 0.05, a fortieth of their spread.
TEST(RecordLevels, AreThoseOfTheSensor) {
  for (const bool holds_out : {true, false}) {
    const auto found = levelled(recordsOf(9, 1), holds_out);
    ASSERT_TRUE(found);
    EXPECT_LT(largestError(*found), 0.05);
  }
}

TEST(RecordLevels, AreAbsentWhereTheyHardlyDiffer) {
  EXPECT_FALSE(levelled(recordsOf(9, 0)));
  EXPECT_FALSE(levelled(recordsOf(9, 0.003)));
}

TEST(RecordLevels, AreAbsentForTwoRecords) {
  const std::vector<Experiment> all = recordsOf(9, 1);
  WorkerPool pool(1);
  CurveSearchContext context;
  context.pool = &pool;
  context.going_on = [] { return true; };
  const std::vector<Experiment> two{all[0], all[1]};
  EXPECT_FALSE(countedFromOwnLevels(two, {}, planWindows(two), context));
}

SimulationCauses explained(const std::vector<Experiment>& all, bool own_levels) {
  WorkerPool pool(1);
  SimulationSearchOptions options;
  options.own_levels = own_levels;
  const Parts parts = partsOf(all);
  return explainSimulation(parts.fitted, parts.held, options, &pool);
}

TEST(RecordLevels, LetALimitedRateBeSeen) {
  const std::vector<Experiment> all = recordsOf(0.06, 1);
  const SimulationCauses without = explained(all, false), with = explained(all, true);
  EXPECT_FALSE(without.own_levels);
  EXPECT_LT(without.fit_after, 90);
  EXPECT_TRUE(with.own_levels);
  EXPECT_TRUE(test::mentions(with.preparation, "a level of its own"));
  ASSERT_EQ(with.causes.size(), 1u);
  EXPECT_EQ(with.causes[0].what.name, "act_ratelimit");
  EXPECT_GT(with.fit_after, 95);
  // Pictures show the output as it was measured.
  for (const SimulatedWindow& picture : with.pictures)
    EXPECT_LT((picture.measured - picture.after).cwiseAbs().maxCoeff(), 0.3);
  const auto& measured = with.pictures.front().measured;
  const auto record = std::find_if(all.begin(), all.end(), [&](const Experiment& each) {
    return each.id == with.pictures.front().experiment;
  });
  ASSERT_NE(record, all.end());
  EXPECT_GE(measured.minCoeff(), record->y.minCoeff() - 1e-9);
  EXPECT_LE(measured.maxCoeff(), record->y.maxCoeff() + 1e-9);
}

/// Not where the levels are equal: the search is the usual one.
TEST(RecordLevels, AreNotUsedWithoutNeed) {
  const SimulationCauses found = explained(recordsOf(0.06, 0), true);
  EXPECT_FALSE(found.own_levels);
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes[0].what.name, "act_ratelimit");
}

}  // namespace
}  // namespace uncertainty_identification
