#include "session/simulation_monitor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/wait_for.h"

namespace uncertainty_identification {
namespace {

/// y is `gain` times the simulation "sim", with a little of another sine that differs from
/// experiment to experiment.
std::shared_ptr<const Experiment> comparedExperiment(int number, double gain) {
  Experiment experiment;
  experiment.id = "run" + std::to_string(number);
  experiment.sample_time = 0.1;
  Eigen::VectorXd y_sim(200);
  for (int k = 0; k < 200; ++k) y_sim[k] = std::sin(0.3 * k) + 0.5 * std::sin(0.71 * k);
  experiment.y = gain * y_sim;
  for (int k = 0; k < 200; ++k) experiment.y[k] += 0.05 * std::sin((1 + 0.1 * number) * k);
  experiment.u = y_sim;
  experiment.signals["sim"] = y_sim;
  return std::make_shared<const Experiment>(experiment);
}

std::shared_ptr<const Experiment> withoutSimulation() {
  Experiment experiment = *comparedExperiment(0, 1);
  experiment.id = "without";
  experiment.signals.clear();
  return std::make_shared<const Experiment>(experiment);
}

class SimulationMonitorTest : public testing::Test {
 protected:
  std::size_t toldCount() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return told_.size();
  }

  std::mutex mutex_;
  std::vector<SimulationState> told_;
  SimulationMonitor monitor_{"sim", [this](const SimulationState& state) {
                               const std::lock_guard<std::mutex> lock(mutex_);
                               told_.push_back(state);
                             }};
};

TEST_F(SimulationMonitorTest, TellsEachExperimentInOrderAndTheDrift) {
  EXPECT_FALSE(monitor_.last());
  for (int i = 0; i < 9; ++i) monitor_.add(comparedExperiment(i, i < 6 ? 1 : 1.5));
  ASSERT_TRUE(waitFor([&] { return toldCount() == 9; }));
  EXPECT_EQ(told_[4].errors.id, "run4");
  EXPECT_NEAR(told_[8].errors.gain.value, 1.5, 0.05);
  EXPECT_FALSE(told_[5].drift.drifted) << told_[5].drift.message;
  EXPECT_TRUE(told_[8].drift.drifted) << told_[8].drift.message;
}

TEST_F(SimulationMonitorTest, NamesAnExperimentWithoutTheSimulation) {
  monitor_.add(comparedExperiment(1, 1));
  monitor_.add(withoutSimulation());
  ASSERT_TRUE(waitFor([&] { return monitor_.last() && !monitor_.last()->missing_in.empty(); }));
  EXPECT_EQ(monitor_.last()->missing_in, "without");
  EXPECT_EQ(monitor_.last()->errors.id, "run1");
  EXPECT_EQ(toldCount(), 1U);
}

TEST_F(SimulationMonitorTest, ForgetsAllWithAReset) {
  for (int i = 0; i < 6; ++i) monitor_.add(comparedExperiment(i, 1));
  ASSERT_TRUE(waitFor([&] { return toldCount() == 6; }));
  monitor_.reset();
  EXPECT_FALSE(monitor_.last());
  for (int i = 6; i < 9; ++i) monitor_.add(comparedExperiment(i, 1.5));
  ASSERT_TRUE(waitFor([&] { return toldCount() == 9; }));
  EXPECT_FALSE(monitor_.last()->drift.drifted) << "these are the first ones";
}

}  // namespace
}  // namespace uncertainty_identification
