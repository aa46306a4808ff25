// One record of a plain plant, as a logger writes it: with the defaults.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "math/polynomial.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

constexpr double kRecordGain = 1.05;

/// A heater: lags of 33 s and 8 s, a dead time of two samples, steps of 20 s between two levels,
/// and an output that drifts by a random walk.
Experiment heater(unsigned seed) {
  constexpr int kSamples = 436, kHold = 25, kDelay = 2;
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Experiment experiment;
  experiment.id = "heater";
  experiment.sample_time = 0.8;
  experiment.u.resize(kSamples);
  experiment.y.resize(kSamples);
  const double slow = std::exp(-0.8 / 33), fast = std::exp(-0.8 / 8);
  double flow = 0, temperature = 0, drift = 0;
  for (int k = 0; k < kSamples; ++k) {
    experiment.u[k] = k % kHold > 0 ? experiment.u[k - 1] : normal(engine) > 0 ? 32.5 : 24.5;
    experiment.y[k] = 70.5 + temperature + drift + 0.015 * normal(engine);
    temperature += (1 - slow) * (kRecordGain * flow - temperature);
    flow += (1 - fast) * (experiment.u[std::max(0, k - kDelay)] - 28.5 - flow);
    drift += 0.012 * normal(engine);
  }
  return experiment;
}

// Fitted to nothing but its simulation, a plant with slow poles too many follows the drift by its
// free response: with gains of 0.1 to 1e5 and orders up to 7, before the noise was modelled.
TEST(OneRecord, ADriftIsNotTakenForPolesOfThePlant) {
  Configuration configuration;
  configuration.nominal_model.orders_auto = true;
  configuration.bounds.frequencies = 0;
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
    const Estimate found = Identifier(configuration).identify({heater(seed)});
    const NominalModelEstimate& plant = found.nominal_model;
    EXPECT_LE(plant.a.size(), 3) << "seed " << seed;
    // The drift ends at 0.25 (standard deviation), where the output moves by 4.2.
    EXPECT_NEAR(plant.b.sum() / (1 + plant.a.sum()), kRecordGain, 0.3) << "seed " << seed;
    EXPECT_GT(found.simulation_fit_percent.value_or(0), 85) << "seed " << seed;
  }
}

}  // namespace
}  // namespace uncertainty_identification
