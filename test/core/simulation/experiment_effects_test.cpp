#include "simulation/experiment_effects.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/hidden.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/csv.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using test::expectNear;
using test::unitDelay;
using test::vectorOf;

TEST(ExperimentEffects, FeedbackClosesTheLoopThroughNoiseAndSensor) {
  Truth truth = unitDelay();
  truth.plant.a = vectorOf({-0.5});
  truth.noise.variance = 0.1;
  truth.noise.d = vectorOf({-0.7});
  truth.effects.sensor.lag = {0.3};
  truth.effects.actuator.saturation = {1.5};
  const Experiment open = simulateExperiment(truth, 1, 0);
  truth.effects.experiment.feedback = {0.4};
  const Experiment closed = simulateExperiment(truth, 1, 0);
  EXPECT_EQ(closed.u(0), open.u(0));
  for (int t = 1; t < 200; ++t) EXPECT_NEAR(closed.u(t), open.u(t) - 0.4 * closed.y(t - 1), 1e-12);
  // The record is that of the input: the same experiment with this input, sample by sample.
  Truth noise = truth;
  noise.effects.experiment.feedback.reset();
  noise.effects.sensor.lag.reset();
  noise.plant.b = VectorXd::Zero(1);
  const VectorXd v = simulateExperiment(noise, 1, 0).y;
  double x = 0, y = 0;
  for (int t = 0; t < 200; ++t) {
    if (t > 0) x = 0.5 * x + std::min(1.5, std::max(-1.5, closed.u(t - 1)));
    y = 0.3 * y + 0.7 * (x + v(t));
    EXPECT_NEAR(closed.y(t), y, 1e-11);
  }
}

TEST(ExperimentEffects, FurtherModeTakesItsShare) {
  Truth truth = unitDelay();
  truth.error_model.mixture = {{1.0}, {vectorOf({0.3})}, {Eigen::MatrixXd::Constant(1, 1, 0.04)}};
  const Truth plain = truth;
  truth.effects.experiment.mode = {0.25, vectorOf({5}), 0.1};
  truth.validate();
  constexpr int kCount = 4000;
  int further = 0;
  for (int r = 0; r < kCount; ++r) {
    const DrawnSystem system = drawSystem(truth, 1, r);
    if (system.component == 1) {
      ++further;
      EXPECT_NEAR(system.xi(0), 5, 0.5);
    } else {
      EXPECT_EQ(system.xi, drawSystem(plain, 1, r).xi);
    }
  }
  EXPECT_NEAR(further, 1000, 4 * std::sqrt(750.0));
  truth.error_model.mixture = Mixture();
  EXPECT_THROW(truth.validate(), ConfigurationError);
}

TEST(ExperimentEffects, SecondInputIsRecordedAsD) {
  Truth truth = unitDelay();
  const VectorXd plain = simulateExperiment(truth, 1, 0).y;
  truth.effects.experiment.input2 = {0.8, 0.6};
  const Experiment experiment = simulateExperiment(truth, 1, 0);
  const VectorXd& d = experiment.signals.at("d");
  double x = 0;
  for (int t = 1; t < 200; ++t) {
    x = 0.6 * x + 0.4 * 0.8 * d(t - 1);
    EXPECT_NEAR(experiment.y(t), plain(t) + x, 1e-12);
  }
}

TEST(ExperimentEffects, ClockShiftsTheRecordByWholeSamplesExactly) {
  Truth truth = unitDelay();
  const Experiment plain = simulateExperiment(truth, 1, 0);
  truth.effects.experiment.clock = {1};
  const double unit = drawSystem(truth, 1, 0).effects.clock_shift;
  EXPECT_NE(unit, drawSystem(truth, 1, 1).effects.clock_shift);
  truth.effects.experiment.clock = {2 / std::abs(unit)};
  const int shift = unit > 0 ? 2 : -2;
  const Experiment experiment = simulateExperiment(truth, 1, 0);
  EXPECT_EQ(experiment.u, plain.u);
  expectNear(experiment.y.segment(2, 196), plain.y.segment(2 + shift, 196), 1e-9);
  EXPECT_NEAR(experiment.y(unit > 0 ? 199 : 0), unit > 0 ? plain.y(199) : 0, 1e-9);
}

TEST(ExperimentEffects, CubicInterpolationIsExactForACubic) {
  Truth truth = unitDelay(100);
  truth.input.variance = 0;
  truth.input.mean = 1;
  truth.plant.a = vectorOf({-2, 1});  // 1/(1 - q^-1)^2: a parabola
  truth.effects.experiment.clock = {2};
  const double tau = drawSystem(truth, 1, 0).effects.clock_shift;
  const VectorXd y = simulateExperiment(truth, 1, 0).y;
  for (int t = 10; t < 90; ++t) EXPECT_NEAR(y(t), (t + tau) * (t + tau + 1) / 2, 1e-8);
}

TEST(ExperimentEffects, JitterIsStampedAndSurvivesAFile) {
  Truth truth = unitDelay(100);
  truth.sample_time = 0.5;
  truth.input.variance = 0;
  truth.input.mean = 1;
  truth.plant.a = vectorOf({-2, 1});
  truth.effects.experiment.jitter = {0.2, 1};
  const Experiment experiment = simulateExperiment(truth, 1, 0);
  const VectorXd delta = experiment.stamp_offset / 0.5;
  EXPECT_LE(delta.cwiseAbs().maxCoeff(), 0.2);
  EXPECT_GT(delta.cwiseAbs().maxCoeff(), 0.15);
  for (int t = 10; t < 90; ++t) {
    const double instant = t + delta(t);
    EXPECT_NEAR(experiment.y(t), instant * (instant + 1) / 2, 1e-8);
  }
  const TemporaryFolder folder;
  writeCsv(folder / "jitter.csv", {experiment});
  Configuration options;
  options.sample_time = 0.5;
  const LoadedData data = readCsv(folder / "jitter.csv", options);
  ASSERT_EQ(data.experiments.size(), 1u);
  // The reader fits the grid, so the offsets come back less their median and slope, by about
  // 0.2 sample times/sqrt(100) each.
  const VectorXd read = data.experiments[0].stamp_offset;
  expectNear(read, experiment.stamp_offset, 0.5 * 4 * 0.2 / 10);
  EXPECT_EQ(data.experiments[0].y, experiment.y);
}

TEST(ExperimentEffects, JitterOfStampsAloneIsADecoy) {
  Truth truth = unitDelay(100);
  const VectorXd plain = simulateExperiment(truth, 1, 0).y;
  truth.effects.experiment.jitter = {0.4, 0};
  const Experiment experiment = simulateExperiment(truth, 1, 0);
  EXPECT_EQ(experiment.stamp_offset.size(), 100);
  expectNear(experiment.y, plain);
}

}  // namespace
}  // namespace uncertainty_identification
