// The test against plants that are not linear: its level on linear plants, and its power. Data: a
// first-order plant whose gain differs between runs, simulated, with coloured noise.
#include "residual_tests/nonlinear_signals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "simulation/simulate.h"
#include "support/core_setup.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

Truth linearTruth() {
  Truth truth;
  truth.sample_time = 0.1;
  truth.experiments = 6;
  truth.samples = {200};
  truth.plant.b = test::vectorOf({0.2});
  truth.plant.a = test::vectorOf({-0.8});
  truth.noise.variance = 1e-2;
  truth.noise.d = test::vectorOf({-0.7});
  return truth;
}

ResidualTests testsOf(const std::vector<Experiment>& experiments) {
  Configuration configuration;
  configuration.nominal_model.orders_auto = false;
  configuration.nominal_model.nd = 1;
  configuration.error_model = paperErrorModel();
  configuration.error_model.taps = 0;
  configuration.bounds.frequencies = 0;
  return Identifier(configuration).identify(experiments).residual_tests;
}

/// Of 150 p-values of linear plants fewer than 2 or more than 17 are below 5 % with probability
/// 0.4 % and 0.2 % (binomial tails), and their mean is within 4 * 0.289/sqrt(150) = 0.094 of 1/2.
TEST(NonlinearSignals, AreNotFoundInTheResidualsOfLinearPlants) {
  constexpr int kSets = 150;
  int rejected = 0;
  double mean = 0;
  for (int set = 1; set <= kSets; ++set) {
    const double p =
        testsOf(simulate(linearTruth(), static_cast<std::uint64_t>(set))).linearity_p_value;
    rejected += p < 0.05 ? 1 : 0;
    mean += p / kSets;
  }
  EXPECT_GE(rejected, 2);
  EXPECT_LE(rejected, 17);
  EXPECT_NEAR(mean, 0.5, 0.094);
}

/// A plant with a second pole, of which the model has one: the residuals depend on the input, whose
/// cube is not independent of it. They depend on nothing that is not linear. In 20 sets p-values
/// below 1e-3 have a probability of 2 %.
TEST(NonlinearSignals, AreNotFoundWhereAPoleIsLacking) {
  Truth truth = linearTruth();
  truth.plant.b = test::vectorOf({0.05, 0.04});
  truth.plant.a = test::vectorOf({-1.5, 0.59});
  truth.noise.variance = 1e-4;
  for (std::uint64_t set = 1; set <= 20; ++set) {
    const ResidualTests tests = testsOf(simulate(truth, set));
    EXPECT_LT(tests.independence_p_value, 1e-3);
    EXPECT_GT(tests.linearity_p_value, 1e-3) << "set " << set;
  }
}

/// The same data with the plant's input bent.
ResidualTests testsThrough(const std::function<double(double)>& curve) {
  std::vector<Experiment> experiments = simulate(linearTruth(), 7);
  for (Experiment& experiment : experiments) {
    double added = 0;
    for (int k = 0; k < experiment.samples(); ++k) {
      experiment.y[k] += added;
      added = 0.8 * added + 0.2 * (curve(experiment.u[k]) - experiment.u[k]);
    }
  }
  return testsOf(experiments);
}

TEST(NonlinearSignals, AreFoundBehindACurvedInput) {
  for (const auto& curve : std::vector<std::function<double(double)>>{
           [](double u) { return u + 0.3 * u * u; },
           [](double u) { return std::abs(u) < 0.5 ? 0
                                 : u > 0           ? u - 0.5
                                                   : u + 0.5; },
           [](double u) { return std::max(-1.0, std::min(u, 1.0)); }}) {
    const ResidualTests tests = testsThrough(curve);
    EXPECT_LT(tests.linearity_p_value, 1e-3);
    EXPECT_GT(tests.nonlinear_share, 0.002);
  }
}

TEST(NonlinearSignals, HaveAMeanSquareOfOne) {
  const std::vector<Experiment> experiments = simulate(linearTruth(), 1);
  const std::vector<Block> blocks = makeBlocks(experiments);
  Polynomials model;
  model.delay = 1;
  model.b = test::vectorOf({0.2});
  model.a = test::vectorOf({-0.8});
  const auto signals = nonlinearSignals(model, blocks);
  ASSERT_EQ(signals.size(), blocks.size());
  for (const Signals& signal : signals.front()) EXPECT_NEAR(signal.square().sum(), 6 * 200, 1e-6);
}

}  // namespace
}  // namespace uncertainty_identification
