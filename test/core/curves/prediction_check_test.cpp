// Plants that a controller holds: their free simulation says little, their prediction all.
#include "curves/prediction_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "curves/explain_simulation.h"
#include "curves/preparation.h"

namespace uncertainty_identification {
namespace {

constexpr double kSampleTime = 0.01;  // [s]

/// A record of an axis x'' = growth^2 x - 0.3 x' + f behind a lag of 20 ms, whose controller
/// follows a reference of steps; a negative square of the growth is a spring.
Experiment heldAxis(double square_of_growth, unsigned seed) {
  constexpr int kSamples = 2000;
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Experiment record;
  record.id = "run" + std::to_string(seed);
  record.sample_time = kSampleTime;
  record.u.resize(kSamples);
  record.y.resize(kSamples);
  double x = 0, rate = 0, force = 0, reference = 0, sum = 0, last = 0;
  for (int k = 0; k < kSamples; ++k) {
    if (k % 60 == 0) reference = 0.1 * normal(engine);
    record.y[k] = x + 0.0005 * normal(engine);
    const double error = reference - record.y[k];
    sum += kSampleTime * error;
    const double command = 60 * error + 40 * sum - 9 * (record.y[k] - last) / kSampleTime;
    last = record.y[k];
    record.u[k] = command;
    for (int part = 0; part < 10; ++part) {
      constexpr double kPart = kSampleTime / 10;
      force += kPart / 0.02 * (command - force);
      rate += kPart * (square_of_growth * x - 0.3 * rate + force);
      x += kPart * rate;
    }
  }
  return record;
}

SimulationData windowsOfAxis(double square_of_growth) {
  const std::vector<Experiment> all{heldAxis(square_of_growth, 1), heldAxis(square_of_growth, 2)};
  return windowsOf(all, planWindows(all), scalesOf(all), 0);
}

TEST(PredictedGrowth, IsThatOfTheUnstablePole) {
  const double growth = predictedGrowth(windowsOfAxis(9));
  EXPECT_NEAR(growth, std::exp(3 * kSampleTime), 0.01) << "a fast axis, seen through noise";
  EXPECT_LT(predictedGrowth(windowsOfAxis(-9)), 1.001);
}

TEST(PredictedGrowth, IsNoneOfFewSamples) {
  SimulationData few = windowsOfAxis(9);
  few.windows.resize(1);
  SimulationWindow& window = few.windows.front();
  for (Eigen::VectorXd* signal : {&window.u, &window.y, &window.time})
    signal->conservativeResize(90);
  window.measured.conservativeResize(90);
  EXPECT_EQ(predictedGrowth(few), 0);
}

/// Records of which the search would name one or two curves.
TEST(ExplainSimulation, NamesNoCurveThatBendsAnUnstablePlantBack) {
  WorkerPool pool(1);
  for (const unsigned seed : {5u, 15u, 22u}) {
    const SimulationCauses found = explainSimulation({heldAxis(16, seed)}, {}, {}, &pool);
    EXPECT_TRUE(found.causes.empty());
    EXPECT_NE(found.refused.find("the plant is unstable"), std::string::npos) << found.refused;
  }
}

}  // namespace
}  // namespace uncertainty_identification
