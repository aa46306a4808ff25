// An actuator that follows its input in a loop, whatever the speed.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "curves/explain_simulation.h"
#include "curves/preparation.h"

namespace uncertainty_identification {
namespace {

/// A first-order plant behind a hysteresis after Bouc and Wen, which yields at 0.3 and makes this
/// share of what passes. It is driven to random levels by ramps.
std::vector<Experiment> hystereticRuns(double share, unsigned seed) {
  constexpr int kRuns = 8, kSamples = 500;
  std::vector<Experiment> all(kRuns);
  for (int r = 0; r < kRuns; ++r) {
    std::mt19937_64 engine(seed + static_cast<unsigned>(r));
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(-1, 1);
    Experiment& run = all[static_cast<std::size_t>(r)];
    run.id = std::to_string(r);
    run.sample_time = 0.01;
    run.u = run.y = Eigen::VectorXd::Zero(kSamples);
    double u = 0, target = 0, z = 0, x = 0;
    for (int k = 0; k < kSamples; ++k) {
      if (k % 40 == 0) target = uniform(engine);
      const double change = std::min(std::max(target - u, -0.05), 0.05);
      u += change;
      z += change - std::abs(change) * z / 0.6 - change * std::abs(z) / 0.6;
      run.u[k] = u;
      run.y[k] = x + 0.005 * normal(engine);
      x += 0.15 * ((1 - share) * u + share * 3 * z - x);
    }
  }
  return all;
}

SimulationCauses explainedHysteresis(const std::vector<Experiment>& all) {
  WorkerPool pool(2);
  return explainSimulation({all.begin(), all.end() - 2}, {all.end() - 2, all.end()}, {}, &pool);
}

TEST(InputHysteresis, IsNamedWithWhatLagsBehind) {
  const SimulationCauses found = explainedHysteresis(hystereticRuns(0.5, 1));
  ASSERT_FALSE(found.causes.empty());
  const SimulationCause& first = found.causes.front();
  EXPECT_EQ(first.what.name, "act_hysteresis");
  EXPECT_GT(found.fit_after, 93);
  ASSERT_EQ(first.values.size(), 2u);
  EXPECT_EQ(first.values[0].name, "gain_after_reversal");
  EXPECT_NEAR(first.values[0].value, 4, 1) << "0.5 + 1.5 against 0.5; four plays are no curve";
  EXPECT_GT(first.values[1].value, 0.05) << "in units of the input, which moves by +-1";
  EXPECT_LT(first.values[1].value, 0.6);
}

TEST(InputHysteresis, IsNotNamedWhereThereIsNone) {
  EXPECT_TRUE(explainedHysteresis(hystereticRuns(0, 7)).causes.empty());
}

/// The plays remember what was before the window.
TEST(InputHysteresis, PlaysBeginWithTheRecord) {
  std::vector<Experiment> all = hystereticRuns(0.5, 3);
  WindowPlan plan = planWindows(all);
  plan.one_of_each = false;
  plan.length = 250;
  const SimulationData data = windowsOf(all, plan, scalesOf(all), 0);
  ASSERT_GT(data.windows.size(), all.size());
  const SimulationWindow &first = data.windows[0], &second = data.windows[1];
  ASSERT_EQ(second.record, first.record);
  Eigen::VectorXd whole(first.samples() + second.samples());
  whole << first.u, second.u;
  EXPECT_EQ(second.plays, playsOf(whole).bottomRows(second.samples()));
  EXPECT_NE(second.plays, playsOf(second.u));
}

TEST(PlaysOf, FollowTheInputOnceItHasCrossedTheirWidth) {
  const Eigen::MatrixXd plays = playsOf(Eigen::Vector4d(0, 1, 0.5, -1));
  for (int p = 0; p < kPlays; ++p) {
    const double width = kPlayWidths[static_cast<std::size_t>(p)];
    EXPECT_DOUBLE_EQ(plays(0, p), 0);
    EXPECT_DOUBLE_EQ(plays(1, p), std::max(0.0, 1 - width));
    EXPECT_DOUBLE_EQ(plays(2, p), std::min(plays(1, p), 0.5 + width));
    EXPECT_DOUBLE_EQ(plays(3, p), std::min(plays(2, p), -1 + width));
  }
}

}  // namespace
}  // namespace uncertainty_identification
