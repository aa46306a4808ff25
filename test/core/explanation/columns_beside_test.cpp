#include "explanation/columns_beside.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/mentions.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {
namespace {

using test::mentions;

/// A shaft: its position is measured, and beside it its speed, the load that brakes it (steps,
/// which act much more than the motor), a load's force that is noise, and one that swings.
Experiment ofAShaft(unsigned seed, int samples) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Experiment run;
  run.id = std::to_string(seed);
  run.sample_time = 0.01;
  run.u = run.y = Eigen::VectorXd::Zero(samples);
  Eigen::VectorXd speed_read = run.u, steps = run.u, noise = run.u, swinging = run.u;
  double position = 0, speed = 0, step = 0;
  for (int t = 0; t < samples; ++t) {
    run.y[t] = position + 1e-4 * normal(random);
    speed_read[t] = speed + 0.02 * normal(random);
    if (t % 40 == 0) run.u[t] = normal(random);
    if (t % 40 != 0) run.u[t] = run.u[t - 1];
    if (t % 30 == 0) step = 5 * normal(random);
    steps[t] = step;
    noise[t] = 5 * normal(random);
    swinging[t] = 5 * (std::sin(0.05 * t) + std::sin(0.13 * t + seed)) + 0.01 * normal(random);
    speed = 0.9 * speed + 0.1 * (run.u[t] - steps[t] + noise[t] + swinging[t]);
    position += 0.01 * speed;
  }
  run.signals = {{"speed", speed_read}, {"steps", steps}, {"noise", noise}, {"swinging", swinging}};
  return run;
}

Split ofShafts(int samples = 400) {
  Split data;
  for (unsigned seed = 1; seed <= 4; ++seed) data.train.push_back(ofAShaft(seed, samples));
  data.held.push_back(ofAShaft(5, samples));
  return data;
}

TEST(ColumnsBeside, AnotherReadingIsLeftOutAndWhatDrivesTheOutputIsNot) {
  Split data = ofShafts();
  const std::vector<std::string> left_out = leaveOutColumnsOfTheLoop({}, &data);
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_TRUE(mentions(left_out.front(), "in speed: it follows")) << left_out.front();
  for (const std::vector<Experiment>& experiments : {data.train, data.held}) {
    for (const Experiment& experiment : experiments) {
      EXPECT_EQ(experiment.signals.count("speed"), 0u);
      EXPECT_EQ(experiment.signals.size(), 3u);
    }
  }
  EXPECT_TRUE(leaveOutColumnsOfTheLoop({}, &data).empty());
}

/// Runs of a shaft that nothing brakes but steps of a load that nobody recorded.
TEST(ColumnsBeside, ExplainTakesNoSpeedForASecondInput) {
  Split data = ofShafts(200);
  std::vector<Experiment> runs = data.train;
  for (unsigned seed = 6; seed < 12; ++seed) runs.push_back(ofAShaft(seed, 200));
  for (Experiment& run : runs) {
    const Eigen::VectorXd speed = run.signals["speed"];
    run.signals = {{"speed", speed}};
  }
  Configuration configuration;
  configuration.nominal_model.orders_auto = false;
  configuration.nominal_model.na = configuration.nominal_model.nb = 2;
  const Explanation found = explain(configuration, runs);
  EXPECT_TRUE(test::anyMentions(found.warnings, "no cause was sought in speed"));
  for (const Cause& cause : found.causes) EXPECT_NE(cause.variant, "speed") << cause.name;
}

/// A tank whose valve a controller moves by `proportional` of the setpoint's distance, and by what
/// it sums up, while the inflow disturbs it.
Experiment ofATank(unsigned seed, double proportional) {
  constexpr int kSamples = 600;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Experiment run;
  run.id = std::to_string(seed);
  run.u = run.y = Eigen::VectorXd::Zero(kSamples);
  Eigen::VectorXd setpoint = run.u, inflow = run.u;
  double level = 50, sum = 10;
  for (int t = 0; t < kSamples; ++t) {
    setpoint[t] = t % 60 == 0 ? 50 + 5 * normal(random) : setpoint[t - 1];
    inflow[t] = t % 45 == 0 ? normal(random) : inflow[t - 1];
    run.y[t] = level + 0.02 * normal(random);
    sum += 0.1 * proportional * (setpoint[t] - run.y[t]);
    run.u[t] = proportional > 0 ? proportional * (setpoint[t] - run.y[t]) + sum
                                : 0.2 * setpoint[t] + inflow[t];
    level = 0.95 * level + 0.25 * (run.u[t] + inflow[t]);
  }
  run.signals = {{"setpoint", setpoint}, {"inflow", inflow}};
  return run;
}

TEST(ColumnsBeside, TheSetpointOfAControllerIsLeftOutAndADisturbanceIsNot) {
  Split data;
  data.train = {ofATank(1, 0.8), ofATank(2, 0.8)};
  const std::vector<std::string> left_out = leaveOutColumnsOfTheLoop({}, &data);
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_TRUE(mentions(left_out.front(), "in setpoint: it moves the input")) << left_out.front();
  EXPECT_EQ(data.train.front().signals.count("inflow"), 1u);
}

TEST(ColumnsBeside, WhatMovesTheInputWithoutTheOutputIsNoSetpointOfALoop) {
  Split data;
  data.train = {ofATank(1, 0), ofATank(2, 0)};
  EXPECT_TRUE(leaveOutColumnsOfTheLoop({}, &data).empty());
}

TEST(ColumnsBeside, MissingReadingsAreNoChanges) {
  Split data = ofShafts();
  for (Experiment& experiment : data.train) {
    experiment.valid.assign(static_cast<std::size_t>(experiment.samples()), 1);
    for (int t = 5; t < experiment.samples(); t += 50) {
      experiment.valid[static_cast<std::size_t>(t)] = 0;
      experiment.y[t] = std::nan("");
      experiment.signals["speed"][t + 20] = std::nan("");
    }
  }
  EXPECT_TRUE(test::anyMentions(leaveOutColumnsOfTheLoop({}, &data), "in speed: it follows"));
}

TEST(ColumnsBeside, WhatTheConfigurationStatesIsTried) {
  Configuration configuration;
  configuration.covariates.resize(1);
  configuration.covariates[0].name = "speed";
  Split data = ofShafts();
  EXPECT_TRUE(leaveOutColumnsOfTheLoop(configuration, &data).empty());
  EXPECT_EQ(data.train.front().signals.count("speed"), 1u);
}

TEST(ColumnsBeside, NothingIsSaidOfFewSamples) {
  Split data = ofShafts(80);
  EXPECT_TRUE(leaveOutColumnsOfTheLoop({}, &data).empty());
}

}  // namespace
}  // namespace uncertainty_identification
