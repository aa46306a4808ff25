// Plants that differ by filters of the input with a mean of their own, as in the paper: the default
// configuration finds this structure and its orders. Simulated, 25 experiments.
#include <gtest/gtest.h>

#include <random>

#include "estimation/mean_plant.h"
#include "estimation/simulation_fit.h"
#include "model/fixed_plant.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

constexpr double kB = 0.4, kPole = 0.7, kNoise = 0.05;
constexpr double kMean[2] = {-0.6, 0.9};  // of the taps q^0 and q^-1; the third makes the sum zero

/// y = 0.4 q^-1/(1 - 0.7 q^-1) (1 + GDelta) u + white noise, from rest.
std::vector<Experiment> filteredPlants(int count, unsigned seed) {
  constexpr int kSamples = 150;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Experiment> all;
  for (int r = 0; r < count; ++r) {
    Experiment experiment;
    experiment.id = "run " + std::to_string(r);
    experiment.sample_time = 0.1;
    experiment.u = experiment.y = Eigen::VectorXd::Zero(kSamples);
    const double first = kMean[0] + 0.15 * normal(random),
                 second = kMean[1] + 0.15 * normal(random);
    const double factor[3] = {1 + first, second, -first - second};
    double x = 0;
    for (int k = 0; k < kSamples; ++k) {
      experiment.y[k] = x + kNoise * normal(random);
      experiment.u[k] = normal(random);
      double filtered = 0;
      for (int lag = 0; lag < std::min(3, k + 1); ++lag)
        filtered += factor[lag] * experiment.u[k - lag];
      x = kPole * x + kB * filtered;
    }
    all.push_back(experiment);
  }
  return all;
}

class FilteredInput : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    experiments_ = filteredPlants(25, 5);
    found_ = Identifier(Configuration()).identify(experiments_, filteredPlants(10, 6));
  }

  static std::vector<Experiment> experiments_;
  static Estimate found_;
};

std::vector<Experiment> FilteredInput::experiments_;
Estimate FilteredInput::found_;

TEST_F(FilteredInput, TheDefaultFindsTheFiltersTheirMeanAndTheOrdersOfGo) {
  const NominalModelEstimate& go = found_.nominal_model;
  ASSERT_EQ(go.b.size(), 1);
  ASSERT_EQ(go.a.size(), 1);
  EXPECT_EQ(go.delay, 1);
  EXPECT_NEAR(go.b[0], kB, 0.02);
  EXPECT_NEAR(go.a[0], -kPole, 0.01);
  EXPECT_EQ(found_.error_model.options.basis, BasisKind::fir);
  const Eigen::VectorXd eta = found_.error_model.T * found_.error_model.mixture.mean();
  ASSERT_EQ(eta.size(), 3);
  // Four standard errors of a mean of 25 plants are 0.12.
  EXPECT_NEAR(eta[0], kMean[0], 0.12);
  EXPECT_NEAR(eta[1], kMean[1], 0.12);
}

TEST_F(FilteredInput, TheMeanPlantIsSimulatedAndNotGo) {
  const auto fitOf = [&](const Polynomials& plant) {
    return simulationFit(*fixPlant(plant, 0, 0), Eigen::VectorXd(0), found_.offset_y,
                         found_.configuration.estimation, experiments_)
        .pooled;
  };
  const double of_mean = fitOf(meanPlant(found_));
  EXPECT_LT(
      fitOf({found_.nominal_model.delay, found_.nominal_model.b, found_.nominal_model.a, {}, {}}),
      of_mean - 20);
  EXPECT_NEAR(*found_.simulation_fit_percent, of_mean, 1);
  EXPECT_NEAR(found_.validation.simulation_fit_percent_pooled, of_mean, 5);
}

}  // namespace
}  // namespace uncertainty_identification
