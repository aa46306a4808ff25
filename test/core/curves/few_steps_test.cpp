// Records of which each is a single step: too few for curves, enough to compare.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "curves/explain_simulation.h"
#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

/// A step to this level after 20 samples, and the answer of a lag with this gain and pole 0.95, in
/// noise of 0.01.
Experiment stepTo(double level, double gain) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  Experiment experiment;
  experiment.id = "step to " + std::to_string(static_cast<int>(level));
  experiment.sample_time = 0.1;
  experiment.u = Eigen::VectorXd::Constant(240, level);
  experiment.u.head(20).setZero();
  experiment.y.resize(240);
  double x = 0;
  for (int k = 0; k < 240; ++k) {
    experiment.y[k] = gain * x + 0.01 * normal(engine);
    x += 0.05 * (experiment.u[k] - x);
  }
  return experiment;
}

SimulationCauses compared(const std::vector<Experiment>& held) {
  WorkerPool pool(1);
  return explainSimulation({stepTo(1, 2), stepTo(2, 2)}, held, {}, &pool);
}

TEST(FewSteps, ShowHowAHeldOutRecordDiffers) {
  const SimulationCauses other = compared({stepTo(3, 3)});
  EXPECT_TRUE(test::mentions(other.skipped, "fewer than six steps"));
  EXPECT_TRUE(other.causes.empty());
  EXPECT_LT(other.fit_before, 80);
  EXPECT_GT(other.held_out_error_ratio, 10);
  EXPECT_TRUE(test::mentions(other.difference, "'step to 3' was not fitted to"));
  EXPECT_TRUE(test::mentions(other.difference, "with 1.5 times the gain")) << other.difference;
  const SimulationCauses same = compared({stepTo(3, 2)});
  EXPECT_GT(same.fit_before, 95);
  EXPECT_EQ(same.difference, "");
}

TEST(FewSteps, AreNotSimulatedWhereNothingIsHeldOut) {
  const SimulationCauses alone = compared({});
  EXPECT_TRUE(test::mentions(alone.skipped, "fewer than six steps"));
  EXPECT_EQ(alone.preparation, "");
  EXPECT_TRUE(std::isnan(alone.fit_before)) << "not 0 %, which nobody measured";
}

}  // namespace
}  // namespace uncertainty_identification
