#include "residual_tests/residual_tests.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/core_setup.h"
#include "support/example1.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

std::vector<Experiment> example1(int count, std::uint64_t seed) {
  Truth truth = loadTruth(std::string(PROJECT_FOLDER) + "/config/example1_truth.yaml");
  truth.experiments = count;
  return simulate(truth, seed);
}

ResidualTests testsOf(const Configuration& configuration, const std::vector<Experiment>& data) {
  return Identifier(configuration).identify(data).residual_tests;
}

/// 120 sets of 25 experiments of Example 1, identified as they are: p-values are uniform, also
/// with free initial states. Of 120 the mean is within 4 * 0.289/sqrt(120) = 0.105 of 1/2, and the
/// count below 0.1 within 4 * sqrt(120 * 0.1 * 0.9) = 13 of 12.
TEST(ResidualTests, PValuesAreUniformWhereTheModelIsTrue) {
  Configuration configuration = example1Configuration();
  configuration.estimation.initial_state = InitialState::estimate;
  configuration.estimation.restarts = 0;
  configuration.bounds.frequencies = 0;
  constexpr int kSets = 120;
  double whiteness = 0, independence = 0;
  int few_white = 0, few_independent = 0;
  for (int set = 0; set < kSets; ++set) {
    const ResidualTests tests =
        testsOf(configuration, example1(25, 100 + static_cast<std::uint64_t>(set)));
    whiteness += tests.whiteness_p_value / kSets;
    independence += tests.independence_p_value / kSets;
    few_white += tests.whiteness_p_value < 0.1 ? 1 : 0;
    few_independent += tests.independence_p_value < 0.1 ? 1 : 0;
  }
  EXPECT_NEAR(whiteness, 0.5, 0.105);
  EXPECT_NEAR(independence, 0.5, 0.105);
  EXPECT_NEAR(few_white, 12, 13);
  EXPECT_NEAR(few_independent, 12, 13);
}

TEST(ResidualTests, ColouredNoiseTakenForWhite) {
  Configuration configuration = example1Configuration();
  configuration.nominal_model.nc = configuration.nominal_model.nd = 0;
  const ResidualTests tests = testsOf(configuration, example1(50, 1));
  EXPECT_LT(tests.whiteness_p_value, 1e-6);
  // The noise C/D = (1 + 0.1 q^-1)/(1 + 0.8 q^-1) has the autocorrelation -0.72 at lag 1.
  EXPECT_NEAR(tests.autocorrelation[0], -0.72, 0.06);
}

TEST(ResidualTests, DynamicsThatThePlantModelMisses) {
  Configuration configuration = example1Configuration();
  configuration.nominal_model.na = 0;
  configuration.error_model.taps = 0;
  configuration.nominal_model.nc = configuration.nominal_model.nd = 3;
  EXPECT_LT(testsOf(configuration, example1(50, 1)).independence_p_value, 1e-6);
}

/// Without error model and nuisances the residuals are the whitened outputs themselves.
TEST(ResidualTests, ByHandWithoutRegressors) {
  Configuration configuration;
  configuration.nominal_model.structure = Structure::output_error;
  configuration.nominal_model.nb = 1;
  configuration.nominal_model.na = 0;
  configuration.nominal_model.delay = 0;
  configuration.error_model.taps = 0;
  configuration.estimation.initial_state = InitialState::zero;
  configuration.estimation.offsets = Offsets::none;
  Truth truth;
  truth.sample_time = 1;
  truth.experiments = 1;
  truth.samples = {60};
  truth.plant.b = test::vectorOf({2.0});
  truth.plant.delay = 0;
  truth.noise.variance = 1;
  const std::vector<Experiment> data = simulate(truth, 3);
  const Estimate estimate = Identifier(configuration).identify(data);
  const Eigen::VectorXd w = data[0].y - estimate.nominal_model.b[0] * data[0].u;
  const ResidualTests& tests = estimate.residual_tests;
  ASSERT_EQ(tests.autocorrelation.size(), 20u);
  EXPECT_EQ(tests.samples, 60);
  EXPECT_NEAR(tests.autocorrelation[2], w.tail(57).dot(w.head(57)) / w.squaredNorm(), 1e-9);
  double sum = 0;
  for (int k = 1; k <= 20; ++k)
    sum += std::pow(w.tail(60 - k).dot(w.head(60 - k)) / w.squaredNorm() * 60, 2) / (60 - k);
  // chi-squared of 20 degrees by its own series: exp(-x/2) sum_{j<10} (x/2)^j/j!
  double term = std::exp(-sum / 2), expected = 0;
  for (int j = 0; j < 10; term *= sum / 2 / ++j) expected += term;
  EXPECT_NEAR(tests.whiteness_p_value, expected, 1e-9);
}

}  // namespace
}  // namespace uncertainty_identification
