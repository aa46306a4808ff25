// A sum of modes under zero-order hold, compared with the step responses of its modes in closed
// form, and its factors along directions.
#include "model/modal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "model/central_differences.h"
#include "support/core_setup.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::vectorOf;

constexpr double kPeriod = 0.1;

NominalModelOptions modal(int reals, int pairs, bool feedthrough = false, int noise = 0) {
  NominalModelOptions options;
  options.structure = Structure::modal;
  options.orders_auto = false;
  options.time_constants = reals;
  options.resonances = pairs;
  options.feedthrough = feedthrough;
  options.nc = options.nd = noise;
  return options;
}

/// tau, residue; omega, zeta, amplitude, phase; then feedthrough.
VectorXd someModes() { return vectorOf({0.7, 2.0, 5.0, 0.1, 3.0, 0.8, 0.25}); }

/// The response to a step at sample 0 by B/A.
VectorXd stepResponseOf(const Polynomials& p, int samples) {
  VectorXd y = VectorXd::Zero(samples);
  for (int t = 0; t < samples; ++t) {
    for (Eigen::Index k = 0; k < p.b.size(); ++k)
      if (t - p.delay - k >= 0) y[t] += p.b[k];
    for (Eigen::Index k = 0; k < p.a.size(); ++k)
      if (t - 1 - k >= 0) y[t] -= p.a[k] * y[t - 1 - k];
  }
  return y;
}

TEST(Modal, RespondsToAStepAsItsModesDo) {
  const VectorXd theta = someModes();
  const VectorXd y = stepResponseOf(makeModal(modal(1, 1, true), kPeriod)->polynomials(theta), 60);
  const std::complex<double> pole(-theta[2] * theta[3],
                                  theta[2] * std::sqrt(1 - theta[3] * theta[3]));
  for (int t = 0; t < 60; ++t) {
    // The feedthrough has a delay of one sample, the modes of two; a hold of u(t) acts from t on.
    const double time = kPeriod * (t - 1);
    const double of_real = theta[1] * theta[0] * (1 - std::exp(-time / theta[0]));
    const double of_pair =
        2 * (std::polar(theta[4], theta[5]) * (std::exp(pole * time) - 1.0) / pole).real();
    EXPECT_NEAR(y[t], t < 1 ? 0 : theta[6] + of_real + of_pair, 1e-10) << "sample " << t;
  }
}

TEST(Modal, DerivativesAreThoseOfDifferences) {
  VectorXd theta(11);
  theta << 0.7, 2.0, 5.0, 0.1, 3.0, 0.8, 12.0, 0.3, 1.0, -2.0, 0.25;
  const auto model = makeModal(modal(1, 2, true), kPeriod);
  EXPECT_LT((model->jacobian(theta) - model->NominalModel::jacobian(theta)).cwiseAbs().maxCoeff(),
            1e-6);
  const VectorXd z = model->toUnbounded(theta);
  EXPECT_LT((model->fromUnbounded(z) - theta).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Modal, IsFoundAgainFromItsPolynomials) {
  VectorXd theta(11);
  theta << 0.7, 2.0, 5.0, 0.1, 3.0, 0.8, 12.0, 0.3, 1.0, -2.0, 0.25;
  const auto model = makeModal(modal(1, 2, true), kPeriod);
  const VectorXd again = model->fromPolynomials(model->polynomials(theta));
  EXPECT_LT((again - theta).cwiseAbs().maxCoeff(), 1e-6) << again.transpose();
}

TEST(Modal, PolesOfAnotherKindGiveAStartThatIsAdmissible) {
  const auto two_real = makeModal(modal(2, 0), kPeriod), pair = makeModal(modal(0, 1), kPeriod);
  const Polynomials of_pair = pair->polynomials(vectorOf({5.0, 0.1, 3.0, 0.8})),
                    of_real = two_real->polynomials(vectorOf({0.7, 2.0, 0.2, -1.0}));
  EXPECT_TRUE(two_real->admissible(two_real->fromPolynomials(of_pair)));
  EXPECT_TRUE(pair->admissible(pair->fromPolynomials(of_real)));
}

TEST(Modal, FactorsMoveItAlongDirections) {
  NominalModelOptions options = modal(1, 1, true, 1);
  const auto modes = makeModal(options, kPeriod);
  VectorXd theta(9);
  theta << someModes(), 0.2, -0.3;
  options.center = modes->toUnbounded(theta).head(7);
  options.directions = MatrixXd::Identity(7, 7);
  options.directions(2, 0) = 0.5;  // factor1 moves tau1 and omega1
  const auto factors = makeModal(options, kPeriod);
  VectorXd at = VectorXd::Ones(9);
  at.tail(2) = theta.tail(2);
  EXPECT_LT((factors->polynomials(at).stacked() - modes->polynomials(theta).stacked())
                .cwiseAbs()
                .maxCoeff(),
            1e-12);
  at[0] = 1.3;
  const ModalParameters moved = modalParameters(options, kPeriod, at);
  ASSERT_EQ(moved.names.size(), 7u);
  EXPECT_NEAR(moved.values[0], theta[0] * std::exp(0.3), 1e-12);
  EXPECT_GT(moved.values[2], theta[2]);
  EXPECT_NEAR(moved.values[4], theta[4], 1e-12);
  EXPECT_LT((factors->jacobian(at) - factors->NominalModel::jacobian(at)).cwiseAbs().maxCoeff(),
            1e-6);
  EXPECT_LT((factors->fromUnbounded(factors->toUnbounded(at)) - at).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((factors->fromPolynomials(factors->polynomials(at)) - at).cwiseAbs().maxCoeff(), 1e-5);
  const MatrixXd differences = centralDifferences(
      [&](const VectorXd& some) { return modalParameters(options, kPeriod, some).values; }, at, 7);
  EXPECT_LT((moved.by_theta - differences).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Modal, RefusesWhatIsNoModel) {
  EXPECT_THROW(makeModal(modal(0, 0), kPeriod), ConfigurationError);
  NominalModelOptions at_once = modal(1, 0);
  at_once.delay = 0;
  EXPECT_THROW(makeModal(at_once, kPeriod), ConfigurationError);
  NominalModelOptions singular = modal(1, 0);
  singular.center = VectorXd::Zero(2);
  singular.directions = MatrixXd::Zero(2, 2);
  EXPECT_THROW(makeModal(singular, kPeriod), ConfigurationError);
  singular.center = VectorXd::Zero(3);
  EXPECT_THROW(singular.validate(), ConfigurationError);
}

}  // namespace
}  // namespace uncertainty_identification
