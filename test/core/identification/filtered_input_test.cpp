// Plants that differ by filters of the input with a mean of their own, as in the paper: the default
// configuration finds this structure and its orders. Simulated, 25 experiments.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "estimation/mean_plant.h"
#include "estimation/simulation_fit.h"
#include "identification/steps.h"
#include "identification/structure_fit.h"
#include "math/polynomial.h"
#include "model/fixed_plant.h"
#include "support/core_setup.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

/// Plants B q^-1/A (1 + GDelta), whose errors are filters of three taps with a sum of zero.
struct FilteredFamily {
  Eigen::VectorXd b, a;
  Eigen::Vector2d mean;  ///< of the taps q^0 and q^-1
  double deviation;      ///< of these taps
  double noise;          ///< [unit of y], white
  double input_pole = 0;
};

FilteredFamily firstOrder() {
  return {test::vectorOf({0.4}), test::vectorOf({-0.7}), {-0.6, 0.9}, 0.15, 0.05};
}

/// Records of plants of the family from rest.
std::vector<Experiment> filteredPlants(const FilteredFamily& family, int count, unsigned seed) {
  constexpr int kSamples = 150;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Experiment> all;
  for (int r = 0; r < count; ++r) {
    Experiment experiment;
    experiment.id = "run " + std::to_string(r);
    experiment.sample_time = 0.1;
    experiment.u = experiment.y = Eigen::VectorXd::Zero(kSamples);
    const double first = family.mean[0] + family.deviation * normal(random),
                 second = family.mean[1] + family.deviation * normal(random);
    const Eigen::VectorXd b =
        product(family.b, test::vectorOf({1 + first, second, -first - second}));
    double input = 0;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(kSamples + 1);
    for (int k = 0; k < kSamples; ++k) {
      experiment.y[k] = x[k] + family.noise * normal(random);
      input = family.input_pole * input +
              std::sqrt(1 - family.input_pole * family.input_pole) * normal(random);
      experiment.u[k] = input;
      for (int lag = 0; lag < std::min<int>(static_cast<int>(b.size()), k + 1); ++lag)
        x[k + 1] += b[lag] * experiment.u[k - lag];
      for (int lag = 0; lag < std::min<int>(static_cast<int>(family.a.size()), k + 1); ++lag)
        x[k + 1] -= family.a[lag] * x[k - lag];
    }
    all.push_back(experiment);
  }
  return all;
}

class FilteredInput : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    experiments_ = filteredPlants(firstOrder(), 25, 5);
    found_ =
        Identifier(Configuration()).identify(experiments_, filteredPlants(firstOrder(), 10, 6));
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
  const FilteredFamily truth = firstOrder();
  EXPECT_NEAR(go.b[0], truth.b[0], 0.02);
  EXPECT_NEAR(go.a[0], truth.a[0], 0.01);
  EXPECT_EQ(found_.error_model.options.basis, BasisKind::fir);
  const Eigen::VectorXd eta = found_.error_model.T * found_.error_model.mixture.mean();
  ASSERT_EQ(eta.size(), 3);
  // Four standard errors of a mean of 25 plants are 0.12.
  EXPECT_NEAR(eta[0], truth.mean[0], 0.12);
  EXPECT_NEAR(eta[1], truth.mean[1], 0.12);
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

struct Comparison {
  FilteredFamily family;
  double loss;  ///< [nats] per experiment, at most, for all that is chosen
};

class FilteredInputOf : public testing::TestWithParam<Comparison> {};

TEST_P(FilteredInputOf, IsPredictedAboutAsWellAsWithItsOwnStructureGiven) {
  const FilteredFamily& family = GetParam().family;
  const auto fitted = filteredPlants(family, 40, 7), held_out = filteredPlants(family, 20, 8);
  const auto density = [&](const Configuration& configuration) {
    return Identifier(configuration)
        .identify(fitted, held_out)
        .validation.log_density_per_experiment;
  };
  Configuration own;
  own.nominal_model.orders_auto = false;
  own.nominal_model.nb = static_cast<int>(family.b.size());
  own.nominal_model.na = static_cast<int>(family.a.size());
  own.nominal_model.nc = own.nominal_model.nd = 0;
  own.error_model.basis = BasisKind::fir;
  own.error_model.constraint = Constraint::zero_static_gain;
  own.error_model.taps = 3;
  own.error_model.components = 1;
  EXPECT_GT(density(Configuration()), density(own) - GetParam().loss);
}

/// Around the mean plant, whose B has three coefficients, no filter describes how the plants
/// differ: their coefficients of B vary together.
Comparison secondOrder() {
  return {{test::vectorOf({0.11}), test::vectorOf({-1.1, 0.28}), {-0.59, -0.52}, 0.14, 0.01}, 1};
}

/// Plants that differ by more than their size, so that their mean simulates hardly one of them. A
/// Go that is fitted to its simulation alone loses 200 nats per experiment.
Comparison scattered() {
  return {{test::vectorOf({0.425, -0.765, 0.321}),
           test::vectorOf({-0.854, 0.764, -0.283}),
           {-1.85, 0.8},
           0.15,
           0.01,
           0.4},
          20};
}

INSTANTIATE_TEST_SUITE_P(Plants, FilteredInputOf, testing::Values(secondOrder(), scattered()));

/// The orders of simpler models may come with another delay than the filters' own.
TEST(FitFilters, ShortensADelay) {
  const FilteredFamily family = firstOrder();
  Journal journal{ProgressPhases({})};
  Configuration configuration;
  const CheckedData data = checkData(configuration, filteredPlants(family, 25, 5), &journal);
  configuration.estimation.initial_state = InitialState::zero;
  configuration.estimation.offsets = Offsets::estimate;
  configuration.nominal_model.max_order = 2;
  configuration.nominal_model.nc = configuration.nominal_model.nd = 0;
  configuration.error_model.max_taps = 3;
  for (const int delay : {0, 3}) {
    configuration.nominal_model.delay = delay;
    const auto found = fitFilters({data, {}, nullptr, configuration, {}, {}}, &journal);
    ASSERT_TRUE(found) << delay;
    EXPECT_EQ(found->start().polynomials.delay, 1) << delay;
    EXPECT_NEAR(found->start().polynomials.a[0], family.a[0], 0.01) << delay;
  }
}

}  // namespace
}  // namespace uncertainty_identification
