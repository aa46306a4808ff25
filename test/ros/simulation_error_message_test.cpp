#include <gtest/gtest.h>

#include <cmath>

#include "ros/simulation_error_publisher.h"

namespace uncertainty_identification {
namespace {

using Level = diagnostic_msgs::DiagnosticStatus;

SimulationState comparedState() {
  SimulationState state;
  state.errors.id = "run";
  state.errors.samples = 300;
  state.errors.gain = {1.1, 0.01, 1.08, 1.12};
  state.errors.untold = {"The fit is not told."};
  state.drift.message = "The simulation is as far from the machine as at first.";
  return state;
}

TEST(SimulationErrorMessage, HoldsAllNumbers) {
  const messages::SimulationError message = toMessage(comparedState(), ros::Time(7));
  EXPECT_EQ(message.header.stamp, ros::Time(7));
  EXPECT_EQ(message.experiment, "run");
  EXPECT_EQ(message.samples, 300U);
  EXPECT_EQ(message.gain.value, 1.1);
  EXPECT_EQ(message.gain.standard_error, 0.01);
  EXPECT_EQ(message.gain.lower, 1.08);
  EXPECT_EQ(message.gain.upper, 1.12);
  EXPECT_TRUE(std::isnan(message.fit.value));
  EXPECT_EQ(message.untold.size(), 1U);
  EXPECT_FALSE(message.drifted);
}

TEST(DiagnoseSimulation, WarnsOfDriftAndOfExperimentsWithoutIt) {
  diagnostic_updater::DiagnosticStatusWrapper status;
  diagnoseSimulation(std::nullopt, status);
  EXPECT_EQ(status.level, Level::OK);
  SimulationState state = comparedState();
  diagnoseSimulation(state, status);
  EXPECT_EQ(status.level, Level::OK);
  state.missing_in = "later";
  diagnoseSimulation(state, status);
  EXPECT_EQ(status.level, Level::WARN);
  EXPECT_NE(status.message.find("experiment 'later' lacks the simulation"), std::string::npos);
  state.missing_in.clear();
  state.drift = {true, "The simulation has drifted away from the machine: gain."};
  diagnoseSimulation(state, status);
  EXPECT_EQ(status.level, Level::WARN);
  EXPECT_EQ(status.message, state.drift.message);
}

}  // namespace
}  // namespace uncertainty_identification
