// Linear plants that differ from run to run in a way that a curve could imitate.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "curves/explain_simulation.h"

namespace uncertainty_identification {
namespace {

/// A run about a power of 20 of a heated tank behind the lags of heater and sensor. The flow moves
/// level, gain and time constant together.
Experiment ofATank(double flow, const std::string& id, std::mt19937_64* engine) {
  constexpr int kLength = 200;
  std::normal_distribution<double> normal;
  Experiment run;
  run.id = id;
  run.sample_time = 30;
  run.u.resize(kLength);
  run.y.resize(kLength);
  double power = 20, heater = 20, tank = 20 * 0.1 / flow, sensor = tank;
  for (int k = 0; k < kLength; ++k) {
    if (k % 12 == 5) power = 20 + 5 * normal(*engine);
    run.u[k] = power;
    run.y[k] = sensor + 0.05 * normal(*engine);
    sensor += 0.4 * (tank - sensor);
    tank += 0.1 * heater - flow * tank;
    heater += 0.3 * (power - heater);
  }
  return run;
}

TEST(DifferingPlants, NothingIsNamedWhereTheFlowOfTanksDiffers) {
  WorkerPool pool(1);
  for (const unsigned seed : {1, 2, 3, 4}) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    std::vector<Experiment> fitted, held;
    for (int r = 0; r < 14; ++r)
      (r < 10 ? fitted : held)
          .push_back(ofATank(0.05 * std::exp(0.15 * normal(engine)), std::to_string(r), &engine));
    const SimulationCauses found = explainSimulation(fitted, held, {}, &pool);
    EXPECT_TRUE(found.causes.empty()) << seed << ": " << found.causes.front().what.name;
  }
}

}  // namespace
}  // namespace uncertainty_identification
