// Draws of plants whose parameters vary, through PlantDistribution.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <complex>

#include "math/polynomial.h"
#include "model/sensitivity.h"
#include "support/core_setup.h"
#include "support/error_message.h"
#include "uncertainty_identification/bounds/plant_distribution.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::vectorOf;

constexpr double kSampleTime = 0.01, kTau = 0.012, kGain = 2, kSpread = 0.1;

/// gain/(1 + tau s), both parameters varying, independently by kSpread each.
Estimate circuit(BasisKind basis, int order = 1, double error = 1e-6) {
  Estimate estimate;
  estimate.configuration.nominal_model.structure = Structure::continuous;
  estimate.configuration.nominal_model.nc = estimate.configuration.nominal_model.nd = 0;
  const auto nominal = makeNominalModel(estimate.configuration.nominal_model, kSampleTime);
  const Polynomials p = nominal->polynomials(vectorOf({kGain, kTau}));
  NominalModelEstimate& go = estimate.nominal_model;
  go = {"continuous", kSampleTime, p.delay, p.b, p.a, p.c, p.d, {}, {}};
  go.parameters = {{"gain", "", kGain, 0, 0}, {"tau1", "s", kTau, 0, 0}};
  ErrorModelOptions& options = estimate.error_model.options;
  options.basis = basis;
  options.constraint = Constraint::zero_mean;
  options.sensitivity_order = order;
  options.parameters = {"tau1", "gain"};
  completeErrorModel(*nominal, &options);
  estimate.error_model.T = MatrixXd::Identity(options.taps, options.taps);
  MatrixXd covariance = MatrixXd::Zero(options.taps, options.taps);
  covariance.diagonal().setConstant(1e-6);
  covariance.diagonal().head(2).setConstant(kSpread * kSpread);
  estimate.error_model.mixture = {{1.0}, {VectorXd::Zero(options.taps)}, {covariance}};
  const int coordinates = 2 + options.taps * (options.taps + 1) / 2;
  estimate.joint_covariance = error * MatrixXd::Identity(coordinates, coordinates);
  return estimate;
}

ArrayXd timeConstants(const PlantSamples& drawn) {
  return -kSampleTime / (-drawn.a.col(0).array()).log();
}

ArrayXd gains(const PlantSamples& drawn) {
  return drawn.b.col(0).array() / (1 + drawn.a.col(0).array());
}

double deviation(const ArrayXd& x) { return std::sqrt((x - x.mean()).square().mean()); }

TEST(VaryingPlant, SpreadDrawsTheParameters) {
  const PlantSamples drawn =
      PlantDistribution(circuit(BasisKind::parameter_spread)).draw(20000, Uncertainty::mixture, 1);
  EXPECT_EQ(drawn.eta.cols(), 0);
  const ArrayXd tau = timeConstants(drawn), gain = gains(drawn);
  const double tolerance = 4 / std::sqrt(2.0 * 20000);  // of a standard deviation, relative
  EXPECT_NEAR(tau.mean(), kTau, 4 * kTau * kSpread / std::sqrt(20000));
  EXPECT_NEAR(deviation(tau), kTau * kSpread, tolerance * kTau * kSpread);
  EXPECT_NEAR(gain.mean(), kGain, 4 * kGain * kSpread / std::sqrt(20000));
  EXPECT_NEAR(deviation(gain), kGain * kSpread, tolerance * kGain * kSpread);
}

/// Estimation errors of theta are drawn in the nominal model's unbounded coordinates, here log tau.
TEST(VaryingPlant, SpreadDrawsTheErrorsOfTheEstimateToo) {
  Estimate estimate = circuit(BasisKind::parameter_spread, 1, 0);
  estimate.joint_covariance(1, 1) = 0.01;
  const PlantSamples drawn = PlantDistribution(estimate).draw(20000, Uncertainty::total, 1);
  const double expected = std::hypot(0.1, kSpread);  // to first order
  EXPECT_NEAR(deviation(timeConstants(drawn)), kTau * expected, 0.04 * kTau * expected);
  EXPECT_NEAR(deviation(gains(drawn)), kGain * kSpread, 0.04 * kGain * kSpread);
}

TEST(VaryingPlant, WhatIsOutsideTheDomainIsDrawnAgain) {
  Estimate estimate = circuit(BasisKind::parameter_spread);
  estimate.error_model.mixture.covariances[0](0, 0) = 0.25;  // tau < 0 at two standard deviations
  const PlantSamples drawn = PlantDistribution(estimate).draw(5000, Uncertainty::mixture, 1);
  EXPECT_GT(timeConstants(drawn).minCoeff(), 0);
  EXPECT_TRUE(drawn.b.allFinite());
}

class SensitivityDraws : public testing::TestWithParam<int> {};

/// Every draw is Go plus a combination of the sensitivities, with the distribution of the mixture.
TEST_P(SensitivityDraws, AreGoAndItsSensitivities) {
  Estimate estimate = circuit(BasisKind::sensitivity, GetParam());
  const auto nominal = makeNominalModel(estimate.configuration.nominal_model, kSampleTime);
  const SensitivityTerms terms = sensitivityTerms(*nominal, estimate.error_model.options);
  const PlantSamples drawn = PlantDistribution(estimate).draw(200, Uncertainty::mixture, 5);
  const VectorXd omega = vectorOf({0.3, 20, 100, 300}), angles = kSampleTime * omega;
  const ComplexResponses found = frequencyResponses(drawn, omega);
  const VectorXd theta = vectorOf({kGain, kTau});
  const Eigen::MatrixXcd R = sensitivityResponses(*nominal, terms, theta, angles);
  const Polynomials p = nominal->polynomials(theta);
  Eigen::MatrixXcd rest(omega.size(), drawn.count());  // G less Go, for xi to explain
  for (Eigen::Index k = 0; k < omega.size(); ++k) {
    const std::complex<double> shift = std::polar(1.0, -angles[k]);
    const std::complex<double> go = p.b[0] / (1.0 + p.a[0] * shift);
    for (int i = 0; i < drawn.count(); ++i)
      rest(k, i) = (std::complex<double>(found.real(i, k), found.imaginary(i, k)) - go) * shift;
  }
  MatrixXd A(2 * omega.size(), terms.count()), b(2 * omega.size(), drawn.count());
  A << R.real(), R.imag();
  b << rest.real(), rest.imag();
  const MatrixXd xi = A.colPivHouseholderQr().solve(b);
  EXPECT_LT((A * xi - b).norm(), 1e-8 * b.norm());
  // 4 standard errors of a standard deviation from 200 draws
  for (int i = 0; i < 2 && GetParam() == 1; ++i)
    EXPECT_NEAR(deviation(xi.row(i).transpose().array()), kSpread, 4 * kSpread / std::sqrt(400.0));
}

INSTANTIATE_TEST_SUITE_P(Orders, SensitivityDraws, testing::Values(1, 2));

TEST(VaryingPlant, AModelOfTheCallersOwnMustBeGiven) {
  Estimate estimate = circuit(BasisKind::parameter_spread);
  estimate.nominal_model.structure = "motor";
  const std::string message = messageOf<DataError>([&] { PlantDistribution{estimate}; });
  EXPECT_NE(message.find("'motor'"), std::string::npos) << message;
  const auto own = makeNominalModel(estimate.configuration.nominal_model, kSampleTime);
  EXPECT_EQ(PlantDistribution(estimate, own).draw(10, Uncertainty::mixture, 1).count(), 10);
}

TEST(VaryingPlant, RefusesPowersOfAnIllConditionedDenominator) {
  Estimate estimate = circuit(BasisKind::sensitivity, 2);
  NominalModelOptions& options = estimate.configuration.nominal_model;
  options = NominalModelOptions();
  options.structure = Structure::output_error;
  options.nb = 1;
  options.na = 4;
  NominalModelEstimate& go = estimate.nominal_model;
  go.structure = "output_error";
  go.b = vectorOf({1e-12});
  go.a = vectorOf({-0.999});
  for (int k = 1; k < 4; ++k) go.a = multiply(go.a, vectorOf({-0.999}));
  go.parameters.clear();
  go.parameters.push_back({"b1", "", go.b[0], 0, 0});
  for (int k = 0; k < 4; ++k)
    go.parameters.push_back({"a" + std::to_string(k + 1), "", go.a[k], 0, 0});
  estimate.error_model.options.parameters = {"b1", "a1"};
  const std::string message = messageOf<DataError>([&] { PlantDistribution{estimate}; });
  EXPECT_NE(message.find("too near to 1"), std::string::npos) << message;
}

}  // namespace
}  // namespace uncertainty_identification
