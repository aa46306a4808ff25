// Whether experiments start at rest, and what that changes: simulated first-order plants whose
// gains differ.
#include <gtest/gtest.h>

#include <random>

#include "identification/steps.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

struct Runs {
  int count = 10;
  double spread = 0.1;    ///< of the gain
  double noise = 0.05;    ///< standard deviation [unit of y]; that of the outputs is about 0.7
  double offset = 0;      ///< [unit of y]
  int before = 0;         ///< samples that are simulated and not recorded
  bool is_heavy = false;  ///< noise with Student's t, 3 degrees of freedom
};

std::vector<Experiment> simulated(const Runs& runs) {
  constexpr int kSamples = 200;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::student_t_distribution<double> heavy(3);
  std::vector<Experiment> all;
  for (int r = 0; r < runs.count; ++r) {
    Experiment experiment;
    experiment.id = "run " + std::to_string(r);
    experiment.sample_time = 0.1;
    experiment.u = experiment.y = Eigen::VectorXd::Zero(kSamples);
    const double gain = 1 + runs.spread * normal(random);
    double x = 0, u = 1;
    for (int k = -runs.before; k < kSamples; ++k) {
      if (k % 5 == 0) u = normal(random) > 0 ? 1 : -1;
      const double noise = runs.is_heavy ? heavy(random) / std::sqrt(3.0) : normal(random);
      if (k >= 0) experiment.u[k] = u;
      if (k >= 0) experiment.y[k] = x + runs.offset + runs.noise * noise;
      x = 0.8 * x + 0.2 * gain * u;
    }
    all.push_back(experiment);
  }
  return all;
}

bool atRest(const Runs& runs) { return startAtRest(simulated(runs), EstimationOptions()); }

TEST(StartAtRest, IsSeenInTheFirstOutputs) {
  Runs runs;
  EXPECT_TRUE(atRest(runs));
  runs.before = 40;
  EXPECT_FALSE(atRest(runs));
}

TEST(StartAtRest, IsAtTheOffsetOfTheOutput) {
  Runs runs;
  runs.offset = 20;
  EXPECT_TRUE(atRest(runs));
}

/// Gains that differ by 30 % are no levels, nor is heavy noise of first readings; offsets that
/// differ by four times the noise are.
TEST(LevelsAtRest, DifferByTheFirstReadingsAlone) {
  Runs runs;
  runs.spread = 0.3;
  runs.offset = 20;
  EXPECT_FALSE(levelsAtRestDiffer(simulated(runs), EstimationOptions()));
  std::vector<Experiment> all = simulated(runs);
  for (std::size_t r = 0; r < all.size(); ++r) all[r].y.array() += r % 2 == 0 ? 0.2 : -0.2;
  EXPECT_TRUE(levelsAtRestDiffer(all, EstimationOptions()));
  runs.is_heavy = true;
  runs.count = 40;
  EXPECT_FALSE(levelsAtRestDiffer(simulated(runs), EstimationOptions()));
}

TEST(StartAtRest, IsSeenInNoise) {
  Runs runs;
  runs.spread = 0;
  runs.noise = 0.3;
  EXPECT_TRUE(atRest(runs));
  runs.is_heavy = true;
  runs.count = 40;
  EXPECT_TRUE(atRest(runs));
  runs.before = 40;
  EXPECT_FALSE(atRest(runs));
}

TEST(StartAtRest, IsDeniedBySomeOfTheExperiments) {
  Runs runs;
  runs.count = 20;
  std::vector<Experiment> all = simulated(runs);
  runs.before = 40;
  const std::vector<Experiment> running = simulated(runs);
  std::copy(running.begin(), running.begin() + 3, all.begin());
  EXPECT_FALSE(startAtRest(all, EstimationOptions()));
}

TEST(StartAtRest, IsNotConcludedWherePlantsDifferMuch) {
  Runs runs;
  runs.count = 60;
  runs.spread = 1;
  runs.before = 40;
  EXPECT_FALSE(atRest(runs));
}

// One model of all such plants leaves most of the outputs; each plant's own model does not.
TEST(StartAtRest, IsSeenByOwnModelsWherePlantsDifferMuch) {
  Runs runs;
  runs.count = 60;
  runs.spread = 1;
  EXPECT_TRUE(atRest(runs));
}

TEST(StartAtRest, IsNotConcludedFromTwoExperiments) {
  Runs runs;
  runs.count = 2;
  EXPECT_FALSE(atRest(runs));
}

// Unknown initial values cost likelihood with each tap of the error model, whether or not it is
// needed; at rest, a model that contains another has no lower likelihood.
TEST(StartAtRest, MakesLikelihoodsOfNestedModelsComparable) {
  Runs runs;
  runs.count = 20;
  Configuration configuration;
  configuration.nominal_model.orders_auto = false;
  configuration.nominal_model.nb = configuration.nominal_model.na = 1;
  configuration.nominal_model.nc = configuration.nominal_model.nd = 0;
  configuration.error_model.basis = BasisKind::fir;
  configuration.error_model.constraint = Constraint::zero_mean;
  configuration.error_model.components = 1;
  const auto logLikelihood = [&](int taps, InitialState state) {
    configuration.error_model.taps = taps;
    configuration.estimation.initial_state = state;
    const Estimate found = Identifier(configuration).identify(simulated(runs));
    if (state == InitialState::automatic) EXPECT_EQ(found.candidates[0].description, "at rest");
    return found.log_likelihood;
  };
  EXPECT_LT(logLikelihood(3, InitialState::estimate), logLikelihood(1, InitialState::estimate) - 9);
  EXPECT_GT(logLikelihood(3, InitialState::automatic),
            logLikelihood(1, InitialState::automatic) - 0.1);
}

}  // namespace
}  // namespace uncertainty_identification
