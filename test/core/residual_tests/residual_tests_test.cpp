#include "residual_tests/residual_tests.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "math/distributions.h"
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

/// The share of `sets` correct models of one record of 300 samples that the tests reject at 5 %.
struct Rejections {
  int whiteness = 0, independence = 0;
};
Rejections rejectionsOfOneRecord(int sets) {
  Configuration configuration;
  configuration.nominal_model.orders_auto = false;
  configuration.error_model = paperErrorModel();
  configuration.error_model.taps = 0;
  configuration.bounds.frequencies = 0;
  Truth truth;
  truth.sample_time = 1;
  truth.experiments = 1;
  truth.samples = {300};
  truth.plant.a = test::vectorOf({-0.7});
  truth.noise.variance = 0.1;
  truth.noise.c = test::vectorOf({0.1});
  truth.noise.d = test::vectorOf({-0.6});
  Rejections rejected;
  for (int set = 1; set <= sets; ++set) {
    const ResidualTests tests =
        testsOf(configuration, simulate(truth, static_cast<std::uint64_t>(set)));
    rejected.whiteness += tests.whiteness_p_value < 0.05 ? 1 : 0;
    rejected.independence += tests.independence_p_value < 0.05 ? 1 : 0;
  }
  return rejected;
}

/// Of 300 tests at 5 % fewer than 5 or more than 28 reject with probability 0.2 % and 0.05 %
/// (binomial tails).
TEST(ResidualTests, RejectCorrectModelsOfOneRecordAsOftenAsTheyShould) {
  const Rejections rejected = rejectionsOfOneRecord(300);
  EXPECT_GE(rejected.whiteness, 5);
  EXPECT_LE(rejected.whiteness, 28);
  EXPECT_GE(rejected.independence, 5);
  EXPECT_LE(rejected.independence, 28);
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

/// p-value of the F test that the regression on all columns is no better than on the first one.
double pValueOfRegression(const Eigen::MatrixXd& columns, const Eigen::VectorXd& w) {
  const auto restOf = [&](const Eigen::MatrixXd& X) {
    const Eigen::VectorXd fitted = X * (X.transpose() * X).ldlt().solve(X.transpose() * w);
    return (w - fitted).squaredNorm();
  };
  const double tested = static_cast<double>(columns.cols()) - 1;
  const double degrees = static_cast<double>(w.size() - columns.cols());
  const double rest = restOf(columns);
  return fisherTail((restOf(columns.leftCols(1)) - rest) / tested / (rest / degrees), tested,
                    degrees);
}

/// Without error model and nuisances the residuals are the whitened outputs themselves.
TEST(ResidualTests, ByHandWithoutRegressors) {
  Configuration configuration;
  configuration.nominal_model.orders_auto = false;
  configuration.nominal_model.structure = Structure::output_error;
  configuration.nominal_model.nb = 1;
  configuration.nominal_model.na = 0;
  configuration.nominal_model.delay = 0;
  configuration.error_model = paperErrorModel();
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
  // F tests of regressions of the residuals on their past and on past inputs, b1 estimated too
  Eigen::MatrixXd past = Eigen::MatrixXd::Zero(60, 21), inputs = Eigen::MatrixXd::Zero(60, 22);
  past.col(0) = inputs.col(0) = data[0].u;
  const Eigen::VectorXd u = data[0].u.array() - data[0].u.mean();
  for (int k = 1; k <= 20; ++k) past.col(k).tail(60 - k) = w.head(60 - k);
  for (int k = 0; k <= 20; ++k) inputs.col(1 + k).tail(40) = u.segment(20 - k, 40);
  EXPECT_NEAR(tests.whiteness_p_value, pValueOfRegression(past, w), 1e-9);
  EXPECT_NEAR(tests.independence_p_value, pValueOfRegression(inputs, w), 1e-9);
}

}  // namespace
}  // namespace uncertainty_identification
