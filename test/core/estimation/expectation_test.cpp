#include "estimation/expectation.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include <vector>

#include "estimation/small_cholesky.h"
#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd squareOf(const Eigen::Ref<const VectorXd>& column) {
  const auto size = static_cast<Index>(std::lround(std::sqrt(static_cast<double>(column.size()))));
  return Eigen::Map<const MatrixXd>(column.data(), size, size);
}

class Posterior : public testing::TestWithParam<int> {};

/// (23), (31) and (32) of the fast E-step are those of N x N matrices.
TEST_P(Posterior, IsThatOfTheDenseReference) {
  test::RandomSystemOptions options;
  options.taps = GetParam() + 1;
  options.components = 3;
  options.experiments = 9;
  options.missing = 0.1;
  options.input_deviation = 0.5;  // so that responsibilities are neither 0 nor 1
  auto system = test::randomSystem(options, 17);
  Configuration configuration = test::configurationOf(options);
  configuration.estimation.noise_start = NoiseStart::stationary;
  dense::Options stationary;
  stationary.noise_start = NoiseStart::stationary;
  const Index n = GetParam();
  for (bool singular : {false, true}) {
    if (singular) system.truth.mixture.covariances[1] = MatrixXd::Ones(n, n);
    if (singular) system.truth.mixture.covariances[2].setZero();
    const ModelParameters at = test::parametersOf(system.truth);
    const Expectation e = test::CoreSetup(configuration, system.experiments).expect(at);
    for (Index r = 0; r < 9; ++r) {
      const auto expected = dense::evaluate(system.experiments[static_cast<std::size_t>(r)],
                                            system.truth, stationary);
      EXPECT_NEAR(e.responsibilities.col(r).sum(), 1, 1e-14);
      for (Index i = 0; i < 3; ++i) {
        const auto component = static_cast<std::size_t>(i);
        EXPECT_NEAR(e.responsibilities(i, r), expected.responsibilities[component], 1e-9);
        EXPECT_LT((e.means.col(3 * r + i) - expected.error_means[component]).norm(), 1e-9);
        EXPECT_LT(
            (squareOf(e.covariances.col(3 * r + i)) - expected.error_covariances[component]).norm(),
            1e-9);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Posterior, testing::Values(1, 2, 3, 4, 7));

/// (33): the expected squared distance of e from Phi xi under the posterior.
TEST(Misfit, IsTheExpectedSquaredResidual) {
  Statistics statistics(1, 2, 0);
  MatrixXd signals = MatrixXd::Random(30, 3);  // [Phi e]
  statistics.gram(0) = signals.transpose() * signals;
  statistics.samples()[0] = 30;
  statistics.logJacobian()[0] = -1.5;
  const Mixture mixture{{1.0}, {Eigen::Vector2d(0.3, -0.2)}, {0.1 * MatrixXd::Identity(2, 2)}};
  WorkerPool pool(1);
  const Expectation e = expectation(statistics, mixture, 0.4, &pool);
  const MatrixXd Phi = signals.leftCols(2);
  const VectorXd rest = signals.col(2) - Phi * e.means.col(0);
  const double expected =
      rest.squaredNorm() + (Phi.transpose() * Phi * squareOf(e.covariances.col(0))).trace();
  EXPECT_NEAR(e.misfits(0, 0), expected, 1e-12 * expected);

  const MatrixXd V =
      0.4 * MatrixXd::Identity(30, 30) + Phi * mixture.covariances[0] * Phi.transpose();
  const Eigen::LLT<MatrixXd> factor(V);
  const VectorXd r = factor.matrixL().solve(signals.col(2) - Phi * mixture.means[0]);
  const double log_density = -0.5 * (30 * std::log(2 * std::acos(-1.0)) + r.squaredNorm()) -
                             factor.matrixLLT().diagonal().array().log().sum();
  EXPECT_NEAR(e.total(), log_density - 1.5, 1e-11) << "the log-Jacobian counts";
}

/// Densities far below the smallest double must neither vanish nor give NaN.
TEST(Responsibilities, SurviveUnderflow) {
  Statistics statistics(2, 1, 0);
  for (int r = 0; r < 2; ++r) {
    statistics.gram(r) << 1e6, 1e6, 1e6, 1e6 + 100;
    statistics.samples()[r] = 100;
    statistics.logJacobian()[r] = 0;
  }
  const VectorXd near = VectorXd::Constant(1, 1.1), far = VectorXd::Constant(1, -300);
  const MatrixXd narrow = MatrixXd::Constant(1, 1, 1e-8);
  WorkerPool pool(2);
  const Expectation e =
      expectation(statistics, {{0.5, 0.5}, {near, far}, {narrow, narrow}}, 1.0, &pool);
  EXPECT_TRUE(std::isfinite(e.total()));
  EXPECT_EQ(e.responsibilities(0, 0), 1);
  EXPECT_LT(e.responsibilities(1, 1), 1e-300);
  const Expectation worse =
      expectation(statistics, {{0.5, 0.5}, {far, far}, {narrow, narrow}}, 1.0, &pool);
  EXPECT_TRUE(std::isfinite(worse.total()));
  EXPECT_NEAR(worse.responsibilities(0, 0), 0.5, 1e-12);
}

TEST(LatentMoments, AreThoseOfTheMixedPosterior) {
  Expectation e;
  e.responsibilities.resize(2, 1);
  e.responsibilities << 0.25, 0.75;
  e.means.resize(1, 2);
  e.means << 2, -2;
  e.covariances.resize(1, 2);
  e.covariances << 0.4, 0.8;
  const LatentMoments moments = latentMoments(e);
  EXPECT_NEAR(moments.means(0, 0), -1, 1e-15);
  EXPECT_NEAR(moments.covariances(0, 0), 0.25 * 0.4 + 0.75 * 0.8 + 3, 1e-15);
}

TEST(SquareRoot, OfSingularCovariances) {
  MatrixXd singular(3, 3);
  singular << 4, 2, 0, 2, 1, 0, 0, 0, 0;
  std::vector<MatrixXd> covariances = {singular};
  covariances.push_back(MatrixXd::Zero(3, 3));
  covariances.push_back(MatrixXd::Identity(3, 3));
  covariances.push_back(MatrixXd::Constant(1, 1, 0.0));
  covariances.push_back(MatrixXd::Constant(1, 1, 9.0));
  for (const MatrixXd& covariance : covariances) {
    const MatrixXd L = squareRoot(covariance);
    EXPECT_LT((L * L.transpose() - covariance).norm(), 1e-13);
  }
}

/// Rounding can give a Gram matrix that no signals have, in which Phi explains more than e'e. The
/// likelihood would be unbounded there, so it must not be finite.
TEST(Expectation, HasNoLikelihoodWhereRoundingLeftMoreExplainedThanThereIs) {
  Statistics statistics(1, 1, 0);
  statistics.samples()[0] = 100;
  statistics.logJacobian()[0] = 0;
  const Mixture mixture{{1.0}, {VectorXd::Zero(1)}, {MatrixXd::Constant(1, 1, 1e6)}};
  WorkerPool pool(1);
  for (const double explained : {0.5, 2.0}) {
    statistics.gram(0) << 1, std::sqrt(explained), std::sqrt(explained), 1;
    EXPECT_EQ(std::isfinite(expectation(statistics, mixture, 1e-6, &pool).total()), explained < 1);
  }
}

/// Bits equal those of Eigen's LLT, so that replacing it changed no result.
template <int n>
void expectBitsOfEigen() {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  int failed = 0;
  for (int draw = 0; draw < 2000; ++draw) {
    const auto random = [&] { return normal(engine); };
    const Square<n> root = Square<n>::NullaryExpr(random), B = Square<n>::NullaryExpr(random);
    const Column<n> b = Column<n>::NullaryExpr(random);
    Square<n> K = root * root.transpose();
    if (draw % 7 == 0) K(0, 0) -= 1;  // some are not positive definite
    const Eigen::LLT<Square<n>> expected(K);
    const SmallCholesky<n> found(K);
    ASSERT_EQ(found.succeeded(), expected.info() == Eigen::Success);
    if (!found.succeeded()) {
      ++failed;
      continue;
    }
    EXPECT_EQ(found.solve(b), Column<n>(expected.solve(b)));
    EXPECT_EQ(found.solveColumns(B), Square<n>(expected.solve(B)));
    EXPECT_EQ(found.diagonal(n - 1), expected.matrixLLT()(n - 1, n - 1));
  }
  EXPECT_GT(failed, 10) << "no matrix tried the failure";
}

TEST(SmallCholesky, GivesTheBitsOfEigen) {
  expectBitsOfEigen<1>();
  expectBitsOfEigen<2>();
  expectBitsOfEigen<3>();
}

}  // namespace
}  // namespace uncertainty_identification
