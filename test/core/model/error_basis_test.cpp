#include "uncertainty_identification/model/error_basis.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "support/core_setup.h"
#include "support/error_message.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

ErrorModelOptions options(BasisKind basis, int taps, Constraint constraint = Constraint::free) {
  ErrorModelOptions made;
  made.basis = basis;
  made.taps = taps;
  made.constraint = constraint;
  made.pole = 0.6;
  made.pole_real = -0.3;
  made.pole_imag = 0.65;
  return made;
}

/// Impulse responses of F_k (samples x taps), from the first lane.
MatrixXd impulseResponses(const ErrorBasis& basis, int samples) {
  Signals impulse = Signals::Zero(kLanes, samples);
  impulse(0, 0) = 1;
  MatrixXd responses(samples, basis.taps());
  const std::vector<Signals> filtered = basis.filtered(impulse);
  for (int k = 0; k < basis.taps(); ++k) {
    responses.col(k) = filtered[static_cast<std::size_t>(k)].row(0).matrix().transpose();
    EXPECT_TRUE(filtered[static_cast<std::size_t>(k)].bottomRows(kLanes - 1).isZero(0));
  }
  return responses;
}

class OrthonormalBasis : public testing::TestWithParam<BasisKind> {};

TEST_P(OrthonormalBasis, ImpulseResponsesAreOrthonormal) {
  const MatrixXd F = impulseResponses(ErrorBasis(options(GetParam(), 7)), 800);
  EXPECT_LT((F.transpose() * F - MatrixXd::Identity(7, 7)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_P(OrthonormalBasis, StaticGainsAreSumsOfImpulseResponses) {
  const ErrorBasis basis(options(GetParam(), 5));
  const VectorXd sums = impulseResponses(basis, 800).colwise().sum().transpose();
  EXPECT_LT((basis.staticGains() - sums).norm(), 1e-11);
}

/// A response times the common denominator is a polynomial whose degree is not higher.
TEST_P(OrthonormalBasis, DenominatorIsCommon) {
  for (int taps : {1, 2, 3, 4}) {
    const ErrorBasis basis(options(GetParam(), taps));
    const VectorXd denominator = dense::monic(basis.denominator());
    const MatrixXd F = impulseResponses(basis, 60);
    const Eigen::Index degree = std::max<Eigen::Index>(denominator.size() - 1, taps - 1);
    for (int k = 0; k < taps; ++k) {
      const VectorXd numerator = dense::product(denominator, F.col(k)).head(60);
      EXPECT_LT(numerator.tail(59 - degree).norm(), 1e-12) << "filter " << k << " of " << taps;
    }
  }
}

TEST_P(OrthonormalBasis, ZeroStaticGainSpansAllErrorsWithoutOne) {
  for (int taps : {2, 3, 6}) {
    const ErrorBasis basis(options(GetParam(), taps, Constraint::zero_static_gain));
    EXPECT_EQ(basis.dimension(), taps - 1);
    EXPECT_LT((basis.staticGains().transpose() * basis.T()).norm(), 1e-12);
    EXPECT_EQ(basis.T().colPivHouseholderQr().rank(), taps - 1);
    const VectorXd constant = impulseResponses(basis, 800).colwise().sum() * basis.T();
    EXPECT_LT(constant.norm(), 1e-10);
  }
}

TEST_P(OrthonormalBasis, AppliesTheConstraintToTheFilters) {
  const ErrorBasis basis(options(GetParam(), 4, Constraint::zero_static_gain));
  const Signals x = Signals::Random(kLanes, 50);
  std::vector<Signals> regressors;
  basis.apply(x, &regressors);
  const std::vector<Signals> filtered = basis.filtered(x);
  ASSERT_EQ(regressors.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    Signals expected = Signals::Zero(kLanes, 50);
    for (int k = 0; k < 4; ++k) expected += basis.T()(k, i) * filtered[static_cast<std::size_t>(k)];
    EXPECT_LT((regressors[static_cast<std::size_t>(i)] - expected).abs().maxCoeff(), 1e-13);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, OrthonormalBasis,
                         testing::Values(BasisKind::fir, BasisKind::laguerre, BasisKind::kautz));

TEST(ErrorBasis, IsTheReferenceBasis) {
  EXPECT_LT((impulseResponses(ErrorBasis(options(BasisKind::laguerre, 4)), 60) -
             dense::laguerreBasis(0.6, 4, 60))
                .norm(),
            1e-12);
  EXPECT_LT((impulseResponses(ErrorBasis(options(BasisKind::kautz, 5)), 60) -
             dense::kautzBasis(-0.3, 0.65, 5, 60))
                .norm(),
            1e-12);
}

TEST(ErrorBasis, APoleAtZeroGivesTaps) {
  ErrorModelOptions laguerre = options(BasisKind::laguerre, 4);
  laguerre.pole = 0;
  ErrorModelOptions kautz = options(BasisKind::kautz, 4);
  kautz.pole_real = kautz.pole_imag = 0;
  for (const ErrorModelOptions& one : {laguerre, kautz, options(BasisKind::fir, 4)}) {
    EXPECT_LT((impulseResponses(ErrorBasis(one), 9) - dense::firBasis(4, 9)).norm(), 1e-15);
  }
}

TEST(ErrorBasis, TwoTapsGiveThePapersConstraint) {
  const ErrorBasis basis(options(BasisKind::fir, 2, Constraint::zero_static_gain));
  EXPECT_EQ(basis.T(), Eigen::Vector2d(1, -1));
  EXPECT_EQ(basis.denominator().size(), 0);
}

TEST(ErrorBasis, NoneIsNone) {
  const ErrorBasis basis(options(BasisKind::laguerre, 0));
  EXPECT_EQ(basis.taps(), 0);
  EXPECT_EQ(basis.dimension(), 0);
  EXPECT_EQ(basis.denominator().size(), 0);
  std::vector<Signals> regressors;
  basis.apply(Signals::Zero(kLanes, 3), &regressors);
  EXPECT_TRUE(regressors.empty());
}

TEST(ErrorBasis, TakesAnExplicitConstraint) {
  ErrorModelOptions made = options(BasisKind::fir, 3, Constraint::explicit_matrix);
  made.T.resize(3, 1);
  made.T << 1, -2, 1;
  EXPECT_EQ(ErrorBasis(made).T(), made.T);
  made.T.resize(2, 1);
  const std::string message = messageOf<ConfigurationError>([&] { ErrorBasis{made}; });
  EXPECT_NE(message.find("error_model.T"), std::string::npos) << message;
  EXPECT_NE(message.find("3 rows"), std::string::npos) << message;
  EXPECT_NE(message.find("2 x 1"), std::string::npos) << message;
}

TEST(ErrorBasis, RefusesPolesOutsideAndTooFewTaps) {
  ErrorModelOptions made = options(BasisKind::laguerre, 2);
  made.pole = 1.0;
  EXPECT_THROW(ErrorBasis{made}, ConfigurationError);
  made = options(BasisKind::kautz, 2);
  made.pole_real = 0.8;
  EXPECT_THROW(ErrorBasis{made}, ConfigurationError);
  EXPECT_THROW(ErrorBasis(options(BasisKind::fir, 1, Constraint::zero_static_gain)),
               ConfigurationError);
  EXPECT_THROW(ErrorBasis(options(BasisKind::fir, kAutomatic)), ConfigurationError);
}

}  // namespace
}  // namespace uncertainty_identification
