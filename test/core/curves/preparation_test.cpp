#include "curves/preparation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "data/thinning.h"

namespace uncertainty_identification {
namespace {

/// A sine of `period` samples.
Experiment wave(int samples, double period) {
  Experiment experiment;
  experiment.sample_time = 0.001;
  experiment.u.resize(samples);
  experiment.y.resize(samples);
  for (int k = 0; k < samples; ++k) {
    experiment.u[k] = k;
    experiment.y[k] = 5 + std::sin(2 * M_PI * k / period);
  }
  return experiment;
}

TEST(Preparation, ThinsToTwentyFourSamplesAPeriod) {
  const WindowPlan plan = planWindows({wave(50000, 240)});
  EXPECT_GE(plan.thinning, 8);
  EXPECT_LE(plan.thinning, 10);
}

TEST(Preparation, KeepsTwoThousandFiveHundredSamples) {
  EXPECT_EQ(planWindows({wave(5000, 240)}).thinning, 2);
  EXPECT_EQ(planWindows({wave(2000, 240)}).thinning, 1);
}

TEST(Preparation, ThinnedInputsAreMeansAndOutputsAreTakenAtTheStart) {
  Experiment experiment = wave(10, 7);
  experiment.valid.assign(10, 1);
  experiment.valid[4] = 0;
  experiment.signals["heat"] = experiment.u;
  const Experiment kept = thinned(experiment, 4);
  ASSERT_EQ(kept.samples(), 2);
  EXPECT_DOUBLE_EQ(kept.u[0], 1.5);
  EXPECT_DOUBLE_EQ(kept.u[1], 5.5);
  EXPECT_DOUBLE_EQ(kept.y[1], experiment.y[4]);
  EXPECT_FALSE(kept.isValid(1));
  EXPECT_DOUBLE_EQ(kept.signals.at("heat")[1], 5.5);
  EXPECT_DOUBLE_EQ(kept.sample_time, 0.004);
}

/// A second heater that is off for a whole record is read as a constant.
TEST(Preparation, CovariatesMayBeConstantInSomeExperiments) {
  std::vector<Experiment> fitted(2, wave(400, 24));
  fitted[0].signals["heater"] = fitted[0].u;
  fitted[1].scalars["heater"] = 0;
  std::vector<Experiment> held(1, wave(400, 24));
  held[0].scalars["heater"] = 399;
  const SignalScales scales = scalesOf(fitted, held);
  EXPECT_DOUBLE_EQ(scales.covariates.at("heater").offset, 399 / 4.0);
  const WindowPlan plan = planWindows(fitted);
  const Scale& scale = scales.covariates.at("heater");
  EXPECT_NEAR(windowsOf(held, plan, scales, 0).windows[0].covariates.at("heater")[7],
              (399 - scale.offset) / scale.unit, 1e-12);
  held[0].scalars.clear();
  EXPECT_TRUE(scalesOf(fitted, held).covariates.empty()) << "unknown in one of them";
  fitted[0].signals.clear();
  fitted[0].scalars["heater"] = 1;
  EXPECT_TRUE(scalesOf(fitted).covariates.empty()) << "it never moves";
}

TEST(Preparation, CutsALongRecordAndLeavesManyShortOnesWhole) {
  const std::vector<Experiment> one{wave(2000, 24)};
  const SimulationData cut = windowsOf(one, planWindows(one), scalesOf(one), 0);
  EXPECT_EQ(cut.windows.size(), 10u);
  EXPECT_EQ(cut.groups.size(), 11u);
  EXPECT_NEAR(cut.windows[3].start, 0.6, 1e-12);
  const std::vector<Experiment> many(12, wave(150, 24));
  const SimulationData whole = windowsOf(many, planWindows(many), scalesOf(many), 0);
  EXPECT_EQ(whole.windows.size(), 12u);
  EXPECT_EQ(whole.windows[0].samples(), 150);
}

/// Windows of one experiment tell nothing about each other's plant, so they are left out together.
TEST(Preparation, GroupsTheWindowsOfEachOfManyExperiments) {
  const std::vector<Experiment> many(9, wave(1000, 24));
  const SimulationData data = windowsOf(many, planWindows(many), scalesOf(many), 0);
  EXPECT_GT(data.windows.size(), 9u);
  EXPECT_EQ(data.groups.size(), 10u);
}

TEST(Preparation, PutsTheRestBeforeARecordThatBeganAtRest) {
  Experiment step = wave(600, 24);
  step.u.setConstant(2);
  step.u.head(5).setConstant(1);
  step.y.head(5).setConstant(4);
  const std::vector<Experiment> records{step, wave(600, 24)};
  const SimulationData data = windowsOf(records, planWindows(records), scalesOf(records), 0);
  const SimulationWindow &rested = data.windows.front(), &other = data.windows[1];
  ASSERT_GE(rested.rest, 32);
  EXPECT_EQ(rested.samples(), other.samples() + rested.rest);
  EXPECT_EQ(rested.measuredSamples(), other.samples());
  EXPECT_EQ(data.samples, 1200) << "what was not recorded counts for nothing";
  const Scale &u = data.scales.u, &y = data.scales.y;
  for (int k = 0; k < rested.rest; ++k) {
    EXPECT_DOUBLE_EQ(rested.u[k] * u.unit + u.offset, 1);
    EXPECT_DOUBLE_EQ(rested.y[k] * y.unit + y.offset, 4);
  }
  for (std::size_t w = 1; w < data.windows.size(); ++w) EXPECT_EQ(data.windows[w].rest, 0);
}

TEST(Preparation, MissingOutputsAreNotMeasured) {
  Experiment experiment = wave(600, 24);
  experiment.valid.assign(600, 1);
  experiment.valid[7] = 0;
  experiment.y[7] = std::nan("");
  const SimulationData data =
      windowsOf({experiment}, planWindows({experiment}), scalesOf({experiment}), 0);
  EXPECT_EQ(data.windows[0].measured[7], 0);
  EXPECT_TRUE(data.windows[0].y.allFinite());
  EXPECT_EQ(data.samples, 599);
}

}  // namespace
}  // namespace uncertainty_identification
