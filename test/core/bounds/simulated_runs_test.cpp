#include "uncertainty_identification/bounds/simulated_runs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/core_setup.h"
#include "support/plain_estimate.h"

namespace uncertainty_identification {
namespace {

using test::vectorOf;

/// y(t) = 0.5 y(t-1) + u(t-1) from rest, and an error that alternates.
Experiment run(const std::string& id, int samples, double error) {
  Experiment experiment;
  experiment.id = id;
  experiment.sample_time = 0.1;
  experiment.u = experiment.y = Eigen::VectorXd::Zero(samples);
  double clean = 0;
  for (int t = 0; t < samples; ++t) {
    experiment.u[t] = (t / 5) % 2 == 0 ? 1 : -1;
    if (t > 0) clean = 0.5 * clean + experiment.u[t - 1];
    experiment.y[t] = clean + (t % 2 == 0 ? error : -error);
  }
  return experiment;
}

Estimate usedIn(const std::vector<std::string>& ids) {
  Estimate estimate = test::estimateWithoutErrorModel(vectorOf({1.0}), vectorOf({-0.5}));
  estimate.configuration.estimation.initial_state = InitialState::zero;
  for (const std::string& id : ids) estimate.experiments.push_back({id, 100, {}, {}, 0});
  return estimate;
}

TEST(SimulatedRuns, AreTheBestTheMedianAndTheWorst) {
  const std::vector<Experiment> data{run("poor", 100, 0.5), run("perfect", 100, 0),
                                     run("rejected", 100, 9), run("fair", 100, 0.1)};
  const auto runs = simulatedRuns(usedIn({"poor", "perfect", "fair"}), nullptr, data, {});
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[0].id + " " + runs[1].id + " " + runs[2].id, "perfect fair poor");
  EXPECT_EQ(runs[0].rank + " " + runs[1].rank + " " + runs[2].rank, "best median worst");
  EXPECT_NEAR(runs[0].fit_percent, 100, 1e-9);
  EXPECT_LT((runs[0].simulated - data[1].y).norm(), 1e-12);
  EXPECT_LT((runs[2].simulated - data[1].y).norm(), 1e-12) << "the input is the same";
  EXPECT_EQ(runs[2].measured, data[0].y);
  EXPECT_EQ(runs[2].time_step, 0.1);
  EXPECT_FALSE(runs[2].validation);
  EXPECT_EQ(runs[0].lower.size(), 0);
}

TEST(SimulatedRuns, AreFewerWhereThereAreFewer) {
  Estimate estimate = usedIn({"only"});
  estimate.validation.experiments = {"a", "b"};
  const auto runs = simulatedRuns(estimate, nullptr, {run("only", 50, 0.1)},
                                  {run("a", 50, 0.3), run("b", 50, 0.2)});
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[0].rank, "best");
  EXPECT_TRUE(!runs[0].validation && runs[1].validation && runs[2].validation);
  EXPECT_EQ(runs[1].id + runs[2].id, "ba");
  EXPECT_TRUE(simulatedRuns(usedIn({}), nullptr, {run("only", 50, 0)}, {}).empty());
}

TEST(SimulatedRuns, WithoutVariationHaveNoFitAndComeLast) {
  Experiment constant = run("constant", 50, 0);
  constant.y.setConstant(2);
  const auto runs =
      simulatedRuns(usedIn({"constant", "other"}), nullptr, {constant, run("other", 50, 5)}, {});
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[1].id, "constant");
}

TEST(SimulatedRuns, KeepThePeaksOfLongExperiments) {
  Experiment experiment = run("long", 10000, 0);
  experiment.y[7777] = 40;
  experiment.y[7778] = -30;
  const auto runs = simulatedRuns(usedIn({"long"}), nullptr, {experiment}, {});
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_LE(runs[0].measured.size(), 300);
  EXPECT_GT(runs[0].measured.size(), 250);
  EXPECT_EQ(runs[0].measured.maxCoeff(), 40);
  EXPECT_EQ(runs[0].measured.minCoeff(), -30);
  Eigen::Index peak = 0;
  runs[0].measured.maxCoeff(&peak);
  EXPECT_NEAR(static_cast<double>(peak) * runs[0].time_step, 777.7, 2 * runs[0].time_step);
  EXPECT_NEAR(static_cast<double>(runs[0].measured.size()) * runs[0].time_step, 1000, 10);
}

TEST(SimulatedRuns, ShowNothingWhereNothingWasMeasured) {
  Experiment experiment = run("gap", 100, 0.1);
  experiment.valid.assign(100, 1);
  experiment.valid[42] = 0;
  experiment.y[42] = 1e9;
  const auto runs = simulatedRuns(usedIn({"gap"}), nullptr, {experiment}, {});
  EXPECT_TRUE(std::isnan(runs[0].measured[42]) && std::isnan(runs[0].simulated[42]));
  EXPECT_LT(runs[0].measured.head(42).cwiseAbs().maxCoeff(), 10);
}

TEST(SimulatedRuns, StandInTheirPredictionInterval) {
  PredictionCalibration calibration;
  calibration.folds = {{1, vectorOf({1.0}), vectorOf({-0.5}), 0}};
  for (int k = 0; k < 40; ++k) {
    calibration.fold.push_back(0);
    calibration.scores.push_back(0.01 * k);
  }
  calibrate({0.5, 0.95}, &calibration);
  const std::vector<Experiment> data{run("a", 100, 0.1)};
  const auto runs = simulatedRuns(usedIn({"a"}), &calibration, data, {});
  EXPECT_EQ(runs[0].level, 0.95);
  EXPECT_NEAR((runs[0].upper - runs[0].simulated).maxCoeff(), 0.38, 1e-9);
  EXPECT_NEAR((runs[0].simulated - runs[0].lower).minCoeff(), 0.38, 1e-9);
  calibration.scores.resize(5);  // too few for a finite interval of 95 %
  calibration.fold.resize(5);
  EXPECT_EQ(simulatedRuns(usedIn({"a"}), &calibration, data, {})[0].upper.size(), 0);
}

TEST(SimulatedRuns, StartFromTheStateThatFitsTheFirstSamples) {
  Experiment moving = run("moving", 100, 0);
  for (int t = 0; t < 100; ++t) moving.y[t] += 4 * std::pow(0.5, t);
  Estimate estimate = usedIn({"moving"});
  const auto at_rest = simulatedRuns(estimate, nullptr, {moving}, {});
  EXPECT_NEAR(std::abs(at_rest[0].measured[0] - at_rest[0].simulated[0]), 4, 1e-9);
  estimate.configuration.estimation.initial_state = InitialState::estimate;
  EXPECT_NEAR(simulatedRuns(estimate, nullptr, {moving}, {})[0].fit_percent, 100, 1e-6);
}

TEST(SimulatedRuns, CountTheCommonOffset) {
  Experiment shifted = run("shifted", 100, 0);
  shifted.y.array() += 7;
  Estimate estimate = usedIn({"shifted"});
  estimate.configuration.estimation.offsets = Offsets::estimate;
  estimate.configuration.estimation.offset_side = OffsetSide::output;
  estimate.offset_y = 7;
  const auto runs = simulatedRuns(estimate, nullptr, {shifted}, {});
  EXPECT_NEAR(runs[0].fit_percent, 100, 1e-9);
  EXPECT_EQ(runs[0].measured, shifted.y) << "drawn as measured";
}

}  // namespace
}  // namespace uncertainty_identification
