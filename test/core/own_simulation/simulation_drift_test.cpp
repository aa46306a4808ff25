// Errors of simulations that scatter from experiment to experiment by known amounts, with and
// without a drift.

#include "own_simulation/simulation_drift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace uncertainty_identification {
namespace {

/// Experiments that differ by 1 % in their gain, 0.02 in their bias, 1 ms in their delay and 2 % in
/// their fit, with standard errors that are a hundredth of it.
class ScatteredErrors {
 public:
  explicit ScatteredErrors(unsigned seed) : random_(seed) {}

  SimulationErrors next(double gain = 1) {
    SimulationErrors errors;
    errors.fit = drawn(90, 2);
    errors.bias = drawn(0.1, 0.02);
    errors.gain = drawn(gain, 0.01);
    errors.delay = drawn(0.03, 0.001);
    return errors;
  }

 private:
  ErrorNumber drawn(double mean, double deviation) {
    const double value = std::normal_distribution<double>(mean, deviation)(random_);
    return {value, deviation / 100, value - deviation / 50, value + deviation / 50};
  }

  std::mt19937 random_;
};

SimulationDrift historyOf(int experiments, ScatteredErrors& errors) {
  SimulationDrift drift;
  for (int i = 0; i < experiments; ++i) drift.add(errors.next());
  return drift;
}

// Of 10,000 decisions 10 are expected to be false alarms at most, with a standard deviation of 3.2:
// more than 22 would be 4 standard deviations.
TEST(SimulationDrift, GivesAFalseAlarmInOneOfAThousandDecisions) {
  for (const int experiments : {6, 9, 30}) {
    int alarms = 0;
    for (unsigned seed = 1; seed <= 10000; ++seed) {
      ScatteredErrors errors(seed);
      alarms += historyOf(experiments, errors).decision().drifted;
    }
    EXPECT_LE(alarms, 22) << experiments << " experiments";
    EXPECT_GE(alarms, 1) << "a test that never alarms has lost its power";
  }
}

// Decisions that follow each other share experiments, so that fewer than 95 of 1000 streams alarm.
// There are about 55, with a standard deviation of 7.2.
TEST(SimulationDrift, GivesFewFalseAlarmsInAHundredExperiments) {
  int streams = 0;
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    ScatteredErrors errors(seed);
    SimulationDrift drift;
    bool alarmed = false;
    for (int i = 0; i < 100; ++i) {
      drift.add(errors.next());
      alarmed = alarmed || drift.decision().drifted;
    }
    streams += alarmed;
  }
  EXPECT_LE(streams, 80) << "of 1000";
}

TEST(SimulationDrift, FindsAGainFivePercentHigherWithinFiveExperiments) {
  int found = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    ScatteredErrors errors(seed);
    SimulationDrift drift = historyOf(20, errors);
    for (int i = 0; i < 5; ++i) drift.add(errors.next(1.05));
    found += drift.decision().drifted;
  }
  EXPECT_GE(found, 196);
}

TEST(SimulationDrift, NamesWhatDiffersAndByHowMuch) {
  ScatteredErrors errors(1);
  SimulationDrift drift = historyOf(10, errors);
  for (int i = 0; i < 5; ++i) drift.add(errors.next(2));
  const std::string message = drift.decision().message;
  EXPECT_EQ(message.find("The simulation has drifted away from the machine: gain "), 0U) << message;
  EXPECT_NE(message.find(" in the first 10 experiments, "), std::string::npos) << message;
  EXPECT_NE(message.find(" in the last 5. "), std::string::npos) << message;
  EXPECT_EQ(message.find("bias"), std::string::npos) << message;
}

TEST(SimulationDrift, NeedsSixExperiments) {
  ScatteredErrors errors(1);
  SimulationDrift drift = historyOf(3, errors);
  for (int i = 0; i < 2; ++i) drift.add(errors.next(5));
  EXPECT_FALSE(drift.decision().drifted);
  EXPECT_EQ(drift.decision().message,
            "Whether the simulation drifts is told from 6 experiments on; there are 5.");
}

TEST(SimulationDrift, PassesOverNumbersThatWereNotTold) {
  ScatteredErrors errors(1);
  SimulationDrift drift = historyOf(10, errors);
  for (int i = 0; i < 20; ++i) {
    SimulationErrors untold = errors.next();
    untold.gain = {};
    drift.add(untold);
  }
  EXPECT_FALSE(drift.decision().drifted) << drift.decision().message;
  for (int i = 0; i < 5; ++i) drift.add(errors.next(2));
  const std::string message = drift.decision().message;
  EXPECT_NE(message.find("gain 1 in the first 10 experiments, 2 in the last 5"), std::string::npos)
      << message;
}

// Numbers that are the same to the last digit have no spread; their standard errors remain.
TEST(SimulationDrift, ADifferenceWithinTheStandardErrorsIsNone) {
  SimulationDrift drift;
  SimulationErrors errors;
  for (int i = 0; i < 15; ++i) {
    errors.gain = {i < 10 ? 1.0 : 1.001, 0.01, 0.98, 1.02};
    drift.add(errors);
  }
  EXPECT_FALSE(drift.decision().drifted);
  EXPECT_EQ(drift.decision().message, "The simulation is as far from the machine as at first.");
}

}  // namespace
}  // namespace uncertainty_identification
