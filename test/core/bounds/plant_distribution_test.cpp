#include "uncertainty_identification/bounds/plant_distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "math/polynomial.h"
#include "support/core_setup.h"
#include "support/plain_estimate.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::ArrayXd;
using Eigen::VectorXd;
using test::vectorOf;

double variance(const ArrayXd& x) { return (x - x.mean()).square().mean(); }

TEST(PlantDistribution, DrawsTheMixture) {
  const PlantDistribution plants(test::plainEstimate(vectorOf({1.0}), vectorOf({0.5})));
  const PlantSamples drawn = plants.draw(20000, Uncertainty::mixture, 3);
  EXPECT_EQ(drawn.eta.rows(), 20000);
  EXPECT_EQ(drawn.eta.cols(), 2);
  const ArrayXd xi = drawn.eta.col(0).array();
  EXPECT_LT((drawn.eta.rowwise().sum()).cwiseAbs().maxCoeff(), 1e-12);  // zero static gain
  EXPECT_NEAR(xi.mean(), 0, 4 * std::sqrt(1.2 / 20000));
  EXPECT_NEAR(variance(xi), 1.2, 4 * 1.2 * std::sqrt(2.0 / 20000));
  EXPECT_NEAR((xi > 0).cast<double>().mean(), 0.5, 4 * 0.5 / std::sqrt(20000));
  EXPECT_EQ(variance(drawn.b.col(0).array()), 0);
}

TEST(PlantDistribution, DrawsTheErrorsOfTheEstimate) {
  Estimate estimate = test::plainEstimate(vectorOf({1.0, 0.4}), vectorOf({-1.2, 0.5}), 1e-6);
  estimate.joint_covariance(0, 1) = estimate.joint_covariance(1, 0) = 6e-7;
  const PlantSamples drawn = PlantDistribution(estimate).draw(20000, Uncertainty::total, 3);
  const ArrayXd b1 = drawn.b.col(0).array() - 1, b2 = drawn.b.col(1).array() - 0.4;
  const double tolerance = 4 * 1e-6 * std::sqrt(2.0 / 20000);
  EXPECT_NEAR(variance(b1), 1e-6, tolerance);
  EXPECT_NEAR((b1 * b2).mean(), 6e-7, tolerance);
  Eigen::MatrixXd J;
  fromUnbounded(toUnbounded(vectorOf({-1.2, 0.5})), &J);
  for (int k = 0; k < 2; ++k) {
    const double expected = 1e-6 * J.row(k).squaredNorm();
    EXPECT_NEAR(variance(drawn.a.col(k).array()), expected, 5 * expected * std::sqrt(2.0 / 20000));
  }
}

TEST(PlantDistribution, EveryDrawIsStable) {
  const PlantDistribution plants(test::plainEstimate(vectorOf({1.0}), vectorOf({-0.99}), 1.0));
  const PlantSamples drawn = plants.draw(500, Uncertainty::total, 1);
  for (int i = 0; i < drawn.count(); ++i) EXPECT_TRUE(isStable(drawn.a.row(i).transpose()));
}

TEST(PlantDistribution, SameSeedSameDraws) {
  const PlantDistribution plants(test::plainEstimate(vectorOf({1.0}), vectorOf({0.5})));
  const auto draw = [&](std::uint64_t seed) { return plants.draw(50, Uncertainty::total, seed); };
  EXPECT_EQ(draw(1).eta, draw(1).eta);
  EXPECT_EQ(draw(1).b, draw(1).b);
  EXPECT_NE(draw(1).b, draw(2).b);
}

TEST(PlantDistribution, RefusesWhatHasNoBounds) {
  Estimate estimate = test::plainEstimate(vectorOf({1.0}), vectorOf({-1.01}));
  EXPECT_THROW(PlantDistribution{estimate}, DataError);
  estimate = test::plainEstimate(vectorOf({1.0}), vectorOf({0.5}));
  estimate.joint_covariance.resize(0, 0);
  const PlantDistribution plants(estimate);
  EXPECT_FALSE(plants.hasEstimationErrors());
  EXPECT_NO_THROW(plants.draw(10, Uncertainty::mixture, 1));
  EXPECT_THROW(plants.draw(10, Uncertainty::total, 1), DataError);
}

class Responses : public testing::TestWithParam<BasisKind> {};

/// The frequency response is the Fourier transform of the impulse response.
TEST_P(Responses, OfFrequencyAndOfTimeAgree) {
  Estimate estimate = test::plainEstimate(vectorOf({1.0, 0.5}), vectorOf({-1.1, 0.4}));
  ErrorModelOptions& options = estimate.error_model.options;
  options.basis = GetParam();
  options.taps = 4;
  estimate.nominal_model.delay = 3;
  const PlantDistribution plants(estimate);
  PlantSamples one = plants.nominal();
  one.basis = options;
  one.eta = vectorOf({0.3, -0.2, 0.1, 0.4}).transpose();
  const ArrayXd step = stepResponses(one, 400).row(0).transpose();
  const VectorXd omega = vectorOf({0.1, 3.0, 20.0});
  const ComplexResponses response = frequencyResponses(one, omega);
  for (Eigen::Index k = 0; k < omega.size(); ++k) {
    std::complex<double> sum = 0;
    for (Eigen::Index t = 0; t < step.size(); ++t) {
      const double impulse = step[t] - (t > 0 ? step[t - 1] : 0.0);
      sum += impulse * std::polar(1.0, -omega[k] * 0.1 * static_cast<double>(t - 3));
    }
    EXPECT_NEAR(response.real(0, k), sum.real(), 1e-9);
    EXPECT_NEAR(response.imaginary(0, k), sum.imag(), 1e-9);
  }
}

/// The error model multiplied out has the same response.
TEST_P(Responses, OfTransferFunctionsAgree) {
  const Estimate estimate = test::plainEstimate(vectorOf({1.0, 0.5}), vectorOf({-1.1, 0.4}));
  PlantSamples one = PlantDistribution(estimate).nominal();
  one.basis.basis = GetParam();
  one.basis.taps = 4;
  one.eta = vectorOf({0.3, -0.2, 0.1, 0.4}).transpose();
  const TransferFunctions whole = transferFunctions(one);
  const VectorXd omega = vectorOf({0.1, 3.0, 20.0});
  const ComplexResponses response = frequencyResponses(one, omega);
  EXPECT_EQ(whole.den(0, 0), 1);
  for (Eigen::Index k = 0; k < omega.size(); ++k) {
    std::complex<double> num = 0, den = 0;
    for (Eigen::Index j = 0; j < whole.num.cols(); ++j)
      num += whole.num(0, j) * std::polar(1.0, -omega[k] * 0.1 * static_cast<double>(j));
    for (Eigen::Index j = 0; j < whole.den.cols(); ++j)
      den += whole.den(0, j) * std::polar(1.0, -omega[k] * 0.1 * static_cast<double>(j));
    EXPECT_NEAR(response.real(0, k), (num / den).real(), 1e-9);
    EXPECT_NEAR(response.imaginary(0, k), (num / den).imag(), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Bases, Responses,
                         testing::Values(BasisKind::fir, BasisKind::laguerre, BasisKind::kautz));

TEST(PlantDistribution, DrawsTheNominalPlantAloneWithItsErrors) {
  const Estimate estimate =
      test::plainEstimate(test::vectorOf({1.0}), test::vectorOf({-0.5}), 1e-4);
  const PlantDistribution plants(estimate);
  const PlantSamples drawn = plants.draw(500, Uncertainty::estimate, 3);
  const PlantSamples total = plants.draw(500, Uncertainty::total, 3);
  EXPECT_EQ(drawn.eta, Eigen::MatrixXd::Zero(500, 2));
  EXPECT_EQ(drawn.b, total.b);
  EXPECT_EQ(drawn.a, total.a);
  EXPECT_NEAR(std::sqrt((drawn.b.array() - 1).square().mean()), 0.01, 0.001);
}

}  // namespace
}  // namespace uncertainty_identification
