// A covariate that drives the plant beside the input.
#include <gtest/gtest.h>

#include <random>

#include "curves/explain_simulation.h"
#include "curves/starts_behind.h"

namespace uncertainty_identification {
namespace {

constexpr int kSamples = 400;

/// Runs of a cage that a motor drives through a lag; its payload moves it `ratio` times as much.
std::vector<Experiment> underAPayload(double ratio, double noise) {
  std::vector<Experiment> all(8);
  for (std::size_t r = 0; r < all.size(); ++r) {
    std::mt19937_64 engine(r + 5);
    std::normal_distribution<double> normal;
    Experiment& run = all[r];
    run.id = "run " + std::to_string(r);
    run.sample_time = 0.1;
    run.u.resize(kSamples);
    run.y.resize(kSamples);
    Eigen::VectorXd payload(kSamples);
    double motor = 0, x = 0;
    for (int k = 0; k < kSamples; ++k) {
      run.u[k] = k % 7 == 0 ? normal(engine) : run.u[k - 1];
      payload[k] = k % 45 == 0 ? normal(engine) : payload[k - 1];
      run.y[k] = x + noise * normal(engine);
      x = 0.95 * x + 0.05 * (motor + ratio * payload[k]);
      motor += 0.3 * (run.u[k] - motor);
    }
    run.signals["payload"] = payload;
  }
  return all;
}

TEST(SecondInput, IsFoundWhereItMovesTheOutputMostOfAll) {
  WorkerPool pool(1);
  const std::vector<Experiment> all = underAPayload(-20, 0.05);
  const std::vector<Experiment> fitted(all.begin(), all.end() - 2), held(all.end() - 2, all.end());
  const SimulationCauses found = explainSimulation(fitted, held, {}, &pool);
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes.front().what.name, "exp_input2");
  EXPECT_EQ(found.causes.front().what.covariate, "payload");
  EXPECT_EQ(found.causes.front().what.shape, "linear");
  EXPECT_LT(found.fit_before, 30);
  EXPECT_GT(found.fit_after, 95);
}

TEST(PlantBeside, HasTheRatioOfTheGains) {
  SimulationData data;
  for (const Experiment& run : underAPayload(-9, 0)) {
    SimulationWindow window;
    window.u = run.u;
    window.plays = playsOf(window.u);
    window.y = run.y;
    window.measured = Eigen::ArrayXd::Ones(kSamples);
    window.time = Eigen::VectorXd::LinSpaced(kSamples, 0, 1);
    window.covariates["payload"] = run.signals.at("payload");
    data.windows.push_back(window);
    data.samples += kSamples;
  }
  data.longest = kSamples;
  CurveModel linear;
  linear.order = 1;
  const PlantBesideCovariate found = plantBeside(data, linear, "payload");
  EXPECT_NEAR(found.ratio, -9, 1);  // the first order has no lag of the motor
  ASSERT_EQ(found.plant.order, 1);
  EXPECT_NEAR(found.plant.theta[0], -0.95, 0.01);
}

}  // namespace
}  // namespace uncertainty_identification
