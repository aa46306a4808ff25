#include "curves/curve_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "curves/preparation.h"

namespace uncertainty_identification {
namespace {

constexpr double kShare = 0.03;

/// A search that ended with so many causes, and with this error of left-out windows; the plant
/// without causes leaves 600.
CurveSearchResult endedWith(std::size_t causes, double left_out, double held_error = 1) {
  CurveSearchResult result;
  result.base.left_out = 600;
  result.causes.resize(causes);
  result.fit.left_out = left_out;
  result.held_error = held_error;
  return result;
}

bool better(const CurveSearchResult& other, const CurveSearchResult& than) {
  return isBetter(other, than, kShare);
}

TEST(IsBetter, AskedForATenthLessWithAsManyCauses) {
  EXPECT_TRUE(better(endedWith(1, 89), endedWith(1, 100)));
  EXPECT_FALSE(better(endedWith(1, 91), endedWith(1, 100)));
}

TEST(IsBetter, WithFewerCausesWhereItLeavesAboutAsMuch) {
  EXPECT_TRUE(better(endedWith(0, 109), endedWith(1, 100)));
  EXPECT_FALSE(better(endedWith(0, 111), endedWith(1, 100)));
}

TEST(IsBetter, WithMoreCausesOnlyIfTheyExplainAShareOfTheWhole) {
  EXPECT_TRUE(better(endedWith(2, 69), endedWith(1, 100)));
  EXPECT_FALSE(better(endedWith(2, 71), endedWith(1, 100)));
  EXPECT_FALSE(better(endedWith(3, 0.3), endedWith(1, 3))) << "of 600, one cause leaves 3";
}

TEST(IsBetter, NotWhereHeldOutWindowsLose) {
  EXPECT_FALSE(better(endedWith(1, 10, 1.06), endedWith(1, 100)));
}

/// Two records of a first-order plant behind a dead zone.
std::vector<Experiment> behindDeadZone(double half_width) {
  constexpr int kSamples = 600;
  std::vector<Experiment> all(2);
  std::mt19937_64 engine(4);
  std::normal_distribution<double> normal;
  for (Experiment& each : all) {
    each.sample_time = 0.1;
    each.u.resize(kSamples);
    each.y.resize(kSamples);
    double x = 0;
    for (int k = 0; k < kSamples; ++k) {
      each.u[k] = k % 9 == 0 ? normal(engine) : each.u[k - 1];
      each.y[k] = x + 0.02 * normal(engine);
      const double moves = std::max(std::abs(each.u[k]) - half_width, 0.0);
      x += 0.2 * (std::copysign(moves, each.u[k]) - x);
    }
  }
  return all;
}

struct Searched {
  std::size_t causes;
  double held_error;
};

/// What a search that may find nothing takes of the causes of a search of `suggested`.
Searched takenOf(const std::vector<Experiment>& suggested, const std::vector<Experiment>& all) {
  WorkerPool pool(1);
  CurveSearchContext context;
  context.pool = &pool;
  context.going_on = [] { return true; };
  const WindowPlan plan = planWindows(all);
  const auto search = [&](const std::vector<Experiment>& records, const CurveSearchLimits& limits) {
    const SignalScales scales = scalesOf(all);
    const SimulationData data = windowsOf({records[0]}, plan, scales, 0),
                         held = windowsOf({records[1]}, plan, scales, 0);
    return searchCurves(data, held, limits, context);
  };
  const CurveSearchResult found = search(suggested, {});
  EXPECT_EQ(found.causes.size(), 1u);
  CurveSearchLimits limits;
  limits.max_causes = 0;
  EXPECT_TRUE(search(all, limits).causes.empty());
  limits.suggested = &found;
  const CurveSearchResult taken = search(all, limits);
  return {taken.causes.size(), taken.held_error};
}

TEST(SearchCurves, TakesSuggestedCausesThatSimulateFarBetter) {
  const std::vector<Experiment> all = behindDeadZone(0.5);
  EXPECT_EQ(takenOf(all, all).causes, 1u);
  EXPECT_EQ(takenOf(all, behindDeadZone(0)).causes, 0u) << "the plant is linear";
}

}  // namespace
}  // namespace uncertainty_identification
