// Known systems are found again from their data alone. Tolerance: the estimates are asymptotically
// normal, so each parameter's distance from the truth in standard errors is a standard normal
// number. All of a system's p parameters are tested at once; that any one of them exceeds z when
// all is well has probability at most p times the tail beyond z (Bonferroni). z is set so that
// this equals 0.0027, the chance that a single number exceeds three standard errors: z = 3.8 for
// p = 20. In addition the joint distance of theta, a chi-squared number, stays below its 99.73 %
// quantile.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "support/core_setup.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kThreeSigma = 0.0027;

double bound(std::size_t parameters) {
  const double tail = 0.5 * kThreeSigma / static_cast<double>(parameters);
  return boost::math::quantile(boost::math::complement(boost::math::normal(), tail));
}

void expectNear(const std::vector<ParameterEstimate>& found, const VectorXd& truth,
                std::size_t family) {
  ASSERT_EQ(static_cast<Eigen::Index>(found.size()), truth.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double off = found[k].value - truth[static_cast<Eigen::Index>(k)];
    EXPECT_GT(found[k].standard_error, 0) << found[k].name;
    EXPECT_LT(std::abs(off), bound(family) * found[k].standard_error)
        << found[k].name << " = " << found[k].value << " +- " << found[k].standard_error;
    EXPECT_GT(found[k].robust_standard_error, 0.3 * found[k].standard_error);
    EXPECT_LT(found[k].robust_standard_error, 3 * found[k].standard_error);
  }
}

void expectTruth(const Estimate& estimate, const dense::Model& truth) {
  EXPECT_EQ(estimate.termination, Termination::converged) << estimate.message;
  const std::size_t family =
      estimate.nominal_model.parameters.size() + estimate.error_model.parameters.size() + 1;
  const VectorXd theta = test::parametersOf(truth).parameters;
  expectNear(estimate.nominal_model.parameters, theta, family);

  VectorXd off(theta.size());
  for (Eigen::Index k = 0; k < theta.size(); ++k) {
    off[k] = estimate.nominal_model.parameters[static_cast<std::size_t>(k)].value - theta[k];
  }
  const boost::math::chi_squared distances(static_cast<double>(theta.size()));
  EXPECT_LT(off.dot(estimate.nominal_model.covariance.ldlt().solve(off)),
            boost::math::quantile(boost::math::complement(distances, kThreeSigma)));

  const Mixture& mixture = estimate.error_model.mixture;
  ASSERT_EQ(mixture.components(), truth.mixture.components());
  for (std::size_t i = 1; i < mixture.means.size(); ++i) {
    EXPECT_LT(mixture.means[i - 1][0], mixture.means[i][0]) << "components are not in order";
  }
  Mixture sorted = truth.mixture;
  sorted.sortComponents();
  const VectorXd all = test::naturalCoordinates({VectorXd(0), sorted, 1.0});
  expectNear(estimate.error_model.parameters, all.head(all.size() - 1), family);
  expectNear({estimate.noise_variance}, VectorXd::Constant(1, truth.noise_variance), family);
}

/// Three components in two dimensions, lengths 50 to 500, missing samples, delay 2, plant and noise
/// not at rest at the first sample, and a sensor with an offset.
TEST(Recovery, OfAMixtureOfThreeInTwoDimensions) {
  test::RandomSystemOptions options;
  options.nb = options.na = 2;
  options.delay = 2;
  options.taps = 3;
  options.components = 3;
  options.experiments = 150;
  options.min_samples = 50;
  options.max_samples = 500;
  options.missing = 0.05;
  options.noise_run_up = options.input_run_up = 200;
  options.output_offset = 1.5;
  dense::Model truth = test::randomSystem(options, 1).truth;
  truth.b = test::vectorOf({0.6, 0.3});
  truth.a = test::vectorOf({-1.2, 0.5});
  truth.c = test::vectorOf({0.3});
  truth.d = test::vectorOf({-0.7});
  MatrixXd tilted(2, 2);
  tilted << 0.05, 0.03, 0.03, 0.08;
  truth.mixture = {{0.3, 0.3, 0.4},
                   {Eigen::Vector2d(1.2, -0.5), Eigen::Vector2d(-1, -0.3), Eigen::Vector2d(0, 1)},
                   {tilted, 0.04 * MatrixXd::Identity(2, 2), 0.06 * MatrixXd::Identity(2, 2)}};
  const auto system = test::simulateSystem(truth, options, 77);
  Configuration configuration = test::configurationOf(options);
  configuration.estimation = EstimationOptions();  // as users get it
  const Estimate estimate = Identifier(configuration).identify(system.experiments);
  expectTruth(estimate, truth);
  EXPECT_NEAR(estimate.offset_y, 1.5, 0.05);
  EXPECT_TRUE(estimate.warnings.empty()) << estimate.warnings.front();
}

TEST(Recovery, OfALaguerreBasis) {
  test::RandomSystemOptions options;
  options.nb = 2;
  options.taps = 3;
  options.laguerre_pole = 0.5;
  options.experiments = 120;
  options.min_samples = 100;
  options.max_samples = 200;
  options.missing = 0.05;
  options.noise_run_up = options.input_run_up = 200;
  dense::Model truth = test::randomSystem(options, 1).truth;
  truth.b = test::vectorOf({1.0, 0.5});
  truth.a = test::vectorOf({-0.8});
  truth.c = test::vectorOf({0.2});
  truth.d = test::vectorOf({-0.6});
  truth.mixture = {{0.4, 0.6},
                   {Eigen::Vector2d(-0.8, 0.3), Eigen::Vector2d(0.6, -0.4)},
                   {0.05 * MatrixXd::Identity(2, 2), 0.08 * MatrixXd::Identity(2, 2)}};
  const auto system = test::simulateSystem(truth, options, 78);
  Configuration configuration = test::configurationOf(options);
  configuration.estimation = EstimationOptions();
  expectTruth(Identifier(configuration).identify(system.experiments), truth);
}

}  // namespace
}  // namespace uncertainty_identification
