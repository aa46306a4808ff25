// Whether experiments have levels of their own: simulated plants that differ much, and plants whose
// outputs are shifted.
#include "identification/own_levels.h"

#include <gtest/gtest.h>

#include <random>

#include "identification/steps.h"
#include "simulation/simulate.h"
#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

/// First-order plants with numerators that differ by their whole size, and outputs at levels that
/// scatter by `spread` about `level`.
std::vector<Experiment> measured(double level, double spread, std::uint64_t seed) {
  constexpr int kExperiments = 25, kSamples = 150;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Experiment> all(kExperiments);
  for (Experiment& one : all) {
    one.sample_time = 1;
    one.u.resize(kSamples);
    one.y.resize(kSamples);
    const double first = normal(random), second = normal(random), own = spread * normal(random);
    double x = 0, before = 0;
    for (int t = 0; t < kSamples; ++t) {
      one.u[t] = normal(random);
      one.y[t] = x + level + own + 0.05 * normal(random);
      x = 0.7 * x + first * one.u[t] + second * before;
      before = one.u[t];
    }
  }
  return all;
}

// A false alarm has a probability of 0.1 % per set: 20 sets have one in 2 % of all seeds.
TEST(OwnLevels, AreNotSeenWherePlantsDiffer) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_FALSE(levelsDiffer(measured(0, 0, seed))) << seed;
    EXPECT_FALSE(levelsDiffer(measured(40, 0, seed))) << "a level in common, " << seed;
  }
}

TEST(OwnLevels, AreSeenBesideDifferentPlants) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_TRUE(levelsDiffer(measured(3, 0.1, seed))) << seed;
}

/// First-order plants with relative errors of four taps and about their whole size.
std::vector<Experiment> plantsWithFourTaps(std::uint64_t seed) {
  Truth truth;
  truth.experiments = 40;
  truth.samples = {190};
  truth.plant.b = test::vectorOf({0.64});
  truth.plant.a = test::vectorOf({-0.424});
  truth.error_model.basis.taps = 4;
  const Eigen::MatrixXd covariance = 0.03 * Eigen::MatrixXd::Identity(3, 3);
  truth.error_model.mixture = {
      {0.28, 0.36, 0.36},
      {test::vectorOf({-0.44, -0.68, -0.42}), test::vectorOf({-0.03, -0.29, 0.33}),
       test::vectorOf({-1.14, -0.43, -0.35})},
      {covariance, covariance, covariance}};
  truth.noise.variance = 5e-4;
  return simulate(truth, seed);
}

// Offsets of each experiment's own take up what simple models lack of such plants.
TEST(OwnLevels, AreNotEstimatedWherePlantsDifferMuch) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Journal journal{ProgressPhases({})};
    Configuration configuration;
    const CheckedData data = checkData(configuration, plantsWithFourTaps(seed), &journal);
    configuration.estimation.initial_state = InitialState::estimate;
    Problem problem{data, {}, nullptr, configuration, {}, {}};
    problem.configuration = chooseInitialState(configuration, data, &journal);
    EXPECT_EQ(chooseOffsets(problem, &journal).estimation.offsets, Offsets::estimate) << seed;
    ASSERT_EQ(journal.candidates.size(), 2u);
    EXPECT_LT(*journal.candidates[0].bic, *journal.candidates[1].bic) << seed;
    EXPECT_FALSE(levelsDiffer(data.experiments)) << seed;
  }
}

}  // namespace
}  // namespace uncertainty_identification
