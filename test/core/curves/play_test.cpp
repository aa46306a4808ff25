// A play needs reversals to be told from a dead zone.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "curves/preparation.h"
#include "curves/screening_places.h"
#include "curves/starts.h"
#include "curves/window_fit.h"
#include "math/constants.h"

namespace uncertainty_identification {
namespace {

/// Two runs of a motor of the first order, whose voltage takes these levels one after the other in
/// one run, and the opposite ones in the other.
std::vector<Experiment> staircases(const std::vector<double>& levels, int step) {
  std::vector<Experiment> all(2);
  for (std::size_t r = 0; r < all.size(); ++r) {
    Experiment& run = all[r];
    run.sample_time = 0.01;
    run.u.resize(step * static_cast<int>(levels.size()));
    run.y.resize(run.u.size());
    double speed = 0;
    for (int k = 0; k < run.samples(); ++k) {
      run.u[k] = (r == 0 ? 1 : -1) * levels[static_cast<std::size_t>(k / step)];
      run.y[k] = speed + 0.1 * std::sin(7.0 * k * k);
      speed += 0.04 * (35 * run.u[k] - speed);
    }
  }
  return all;
}

/// Whether the search would try a play of the input or the output in these records.
bool triesPlay(const std::vector<Experiment>& records) {
  WorkerPool pool(1);
  CurveSearchContext context;
  context.pool = &pool;
  context.going_on = [] { return true; };
  const SimulationData data = windowsOf(records, planWindows(records), scalesOf(records), 0);
  const WindowFit fit = fitFreely(data, linearStart(data, 1, false, 0), context.limits(5));
  for (const ScreenedPlace& each : screenPlaces(data, fit, nullptr, context))
    if (each.place.place == Place::play || each.place.place == Place::output_play) return true;
  return false;
}

TEST(Play, IsNotTriedInRecordsThatDoNotReverse) {
  EXPECT_FALSE(triesPlay(staircases({0, 2, 4, 6}, 200)));
  EXPECT_TRUE(triesPlay(staircases({0, 4, 0, 6, 2, 5, 1, 6, 0, 3, 1, 5, 2, 6, 0, 4}, 60)));
}

TEST(ReversalsOf, AreCountedBeyondTheLeast) {
  Eigen::VectorXd waves(200);
  for (int k = 0; k < 200; ++k) waves[k] = std::sin(2 * kPi * k / 50);
  EXPECT_EQ(reversalsOf(waves, 0.1), 8);  // four periods
  EXPECT_EQ(reversalsOf(waves, 2.1), 0);
  EXPECT_EQ(reversalsOf(Eigen::VectorXd::LinSpaced(50, 0, 1), 0.1), 0);
  EXPECT_EQ(reversalsOf(Eigen::VectorXd::Constant(1, 3), 0.1), 0);
}

}  // namespace
}  // namespace uncertainty_identification
