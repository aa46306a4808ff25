
#include "support/hidden_effects/random_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "io/truth_yaml.h"
#include "simulation/simulate.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification::test {
namespace {

Truth drawn(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  return randomTruth({}, random);
}

TEST(RandomTruth, CoversWhatItPromises) {
  std::set<int> orders, components, dimensions;
  std::set<InputKind> inputs;
  int box_jenkins = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Truth truth = drawn(seed);
    ASSERT_NO_THROW(truth.validate());
    orders.insert(static_cast<int>(truth.plant.a.size()));
    components.insert(truth.error_model.mixture.components());
    dimensions.insert(truth.error_model.mixture.dimension());
    inputs.insert(truth.input.kind);
    box_jenkins += truth.noise.d.size() > 0 ? 1 : 0;
    EXPECT_GE(truth.plant.b(0), 0);
    EXPECT_EQ(truth.plant.delay, 1);
  }
  EXPECT_EQ(orders, (std::set<int>{1, 2, 3}));
  EXPECT_EQ(components, (std::set<int>{1, 2, 3}));
  EXPECT_EQ(dimensions, (std::set<int>{1, 2}));
  EXPECT_EQ(inputs.size(), 4u);
  EXPECT_NEAR(box_jenkins, 50, 20);  // four standard deviations
}

TEST(RandomTruth, SignalToNoiseRatio) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Truth truth = drawn(seed);
    truth.experiments = 100;
    const double y = signalScale(truth, 5).y;
    Truth noise = truth;
    noise.plant.b.setZero();
    double power = 0;
    for (const Experiment& experiment : simulate(noise, 6)) power += experiment.y.squaredNorm();
    const double ratio = 10 * std::log10(y * y / (power / (100 * 300)));
    // Inputs differ in power from draw to draw, by a decibel where steps are few.
    EXPECT_GT(ratio, 19);
    EXPECT_LT(ratio, 31);
  }
}

TEST(RandomTruth, OneSeedOneSystem) {
  EXPECT_EQ(toJson(drawn(3)), toJson(drawn(3)));
  EXPECT_NE(toJson(drawn(3)), toJson(drawn(4)));
}

TEST(RandomTruth, DeclaredSimulationHasTheTruthsStructure) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Truth truth = drawn(seed);
    const Configuration declared = declaredSimulation(truth);
    EXPECT_NO_THROW(declared.validate());
    EXPECT_EQ(declared.nominal_model.na, truth.plant.a.size());
    EXPECT_EQ(declared.nominal_model.nb, truth.plant.b.size());
    EXPECT_EQ(declared.nominal_model.nd, truth.noise.d.size());
    EXPECT_EQ(declared.nominal_model.structure,
              truth.noise.d.size() > 0 ? Structure::box_jenkins : Structure::output_error);
    EXPECT_EQ(declared.error_model.taps, truth.error_model.basis.taps);
    EXPECT_EQ(declared.error_model.components, truth.error_model.mixture.components());
    EXPECT_EQ(declared.estimation.initial_state, InitialState::zero);
    EXPECT_EQ(declared.estimation.offsets, Offsets::none);
  }
}

TEST(RandomTruth, TooFewSamplesAreRefused) {
  std::mt19937_64 random(1);
  EXPECT_THROW(randomTruth({30, 10}, random), ConfigurationError);
}

}  // namespace
}  // namespace uncertainty_identification::test
