// The M-step of mixture and noise variance, its constraint, its floor, and pruning.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// An E-step's result with random content: kappa components, n dimensions, M experiments.
struct DrawnMixture {
  DrawnMixture(Index kappa, Index n, Index experiments)
      : statistics(static_cast<int>(experiments), static_cast<int>(n), 0) {
    e.responsibilities = (MatrixXd::Random(kappa, experiments).array() + 1.05).matrix();
    for (Index r = 0; r < experiments; ++r) {
      e.responsibilities.col(r) /= e.responsibilities.col(r).sum();
    }
    e.means = MatrixXd::Random(n, kappa * experiments);
    for (Index k = 0; k < e.means.cols(); ++k) {
      e.means.col(k).array() +=
          static_cast<double>(k % kappa) - 0.4 * static_cast<double>(kappa - 1);
    }
    e.covariances.resize(n * n, kappa * experiments);
    for (Index k = 0; k < e.covariances.cols(); ++k) {
      const MatrixXd root = MatrixXd::Random(n, n);
      const MatrixXd covariance = 0.1 * root * root.transpose();
      e.covariances.col(k) = Eigen::Map<const VectorXd>(covariance.data(), n * n);
    }
    e.misfits = (MatrixXd::Random(kappa, experiments).array() + 5).matrix();
    e.log_likelihood = VectorXd::Zero(experiments);
    statistics.samples() = VectorXd::LinSpaced(experiments, 10, 40);
    at.noise_variance = 1;
    for (Index i = 0; i < kappa; ++i) {
      at.mixture.weights.push_back(1.0 / static_cast<double>(kappa));
      at.mixture.means.push_back(VectorXd::Zero(n));
      const MatrixXd root = MatrixXd::Random(n, n);
      at.mixture.covariances.push_back(root * root.transpose() + 0.1 * MatrixXd::Identity(n, n));
    }
  }

  VectorXd weightedMean(Index i) const {
    VectorXd sum = VectorXd::Zero(e.means.rows());
    const Index kappa = e.responsibilities.rows();
    for (Index r = 0; r < e.responsibilities.cols(); ++r) {
      sum += e.responsibilities(i, r) * e.means.col(r * kappa + i);
    }
    return sum / e.responsibilities.row(i).sum();
  }

  MatrixXd spreadAround(Index i, const VectorXd& mean) const {
    const Index n = e.means.rows(), kappa = e.responsibilities.rows();
    MatrixXd sum = MatrixXd::Zero(n, n);
    for (Index r = 0; r < e.responsibilities.cols(); ++r) {
      const VectorXd away = e.means.col(r * kappa + i) - mean;
      sum += e.responsibilities(i, r) *
             (away * away.transpose() +
              Eigen::Map<const MatrixXd>(e.covariances.col(r * kappa + i).data(), n, n));
    }
    return sum / e.responsibilities.row(i).sum();
  }

  Statistics statistics;
  Expectation e;
  ModelParameters at;
};

TEST(UpdateMixture, FollowsThePapersEquations) {
  DrawnMixture drawn(3, 2, 30);
  OptimisationOptions options;
  options.constraint = Constraint::free;
  updateMixture(drawn.statistics, drawn.e, options, &drawn.at);
  for (Index i = 0; i < 3; ++i) {
    const auto component = static_cast<std::size_t>(i);
    const VectorXd mean = drawn.weightedMean(i);
    EXPECT_NEAR(drawn.at.mixture.weights[component], drawn.e.responsibilities.row(i).sum() / 30,
                1e-14);
    EXPECT_LT((drawn.at.mixture.means[component] - mean).norm(), 1e-13);
    EXPECT_LT((drawn.at.mixture.covariances[component] - drawn.spreadAround(i, mean)).norm(),
              1e-13);
  }
  EXPECT_NEAR(drawn.at.noise_variance,
              drawn.e.responsibilities.cwiseProduct(drawn.e.misfits).sum() /
                  drawn.statistics.samples().sum(),
              1e-14);
}

class ZeroMean : public testing::TestWithParam<int> {};

/// Stationary under sum alpha = 1 and sum alpha mu = 0 at the old covariances: one multiplier
/// lambda = (n_i/alpha_i) Gamma_i^-1 (xibar_i - mu_i) and one n_i/alpha_i - lambda'mu_i = M for
/// all components.
TEST_P(ZeroMean, SolvesTheConstrainedProblem) {
  DrawnMixture drawn(GetParam(), 2, 30);
  const Mixture before = drawn.at.mixture;
  OptimisationOptions options;
  options.constraint = Constraint::zero_mean;
  updateMixture(drawn.statistics, drawn.e, options, &drawn.at);
  const Mixture& mixture = drawn.at.mixture;
  double total = 0;
  for (double weight : mixture.weights) total += weight;
  EXPECT_NEAR(total, 1, 1e-10);
  EXPECT_LT(mixture.mean().norm(), 1e-9);
  VectorXd lambda;
  for (Index i = 0; i < GetParam(); ++i) {
    const auto component = static_cast<std::size_t>(i);
    const double share = drawn.e.responsibilities.row(i).sum() / mixture.weights[component];
    const VectorXd multiplier = share * before.covariances[component].ldlt().solve(
                                            drawn.weightedMean(i) - mixture.means[component]);
    if (i == 0) lambda = multiplier;
    EXPECT_LT((multiplier - lambda).norm(), 1e-7 * lambda.norm());
    EXPECT_NEAR(share - lambda.dot(mixture.means[component]), 30, 1e-7);
    EXPECT_LT(
        (mixture.covariances[component] - drawn.spreadAround(i, mixture.means[component])).norm(),
        1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Components, ZeroMean, testing::Values(2, 3, 4));

/// The errors of all experiments lie on one side of zero. The updated mixture must still be a
/// distribution with zero mean. (All weights tending to zero would give zero mean, too.)
TEST_P(ZeroMean, KeepsADistributionWhereTheDataContradictIt) {
  for (double shift : {0.5, 1.0, 3.0, 10.0}) {
    for (int draw = 0; draw < 20; ++draw) {
      DrawnMixture drawn(GetParam(), 2, 30);
      drawn.e.means.array() += shift;
      OptimisationOptions options;
      options.constraint = Constraint::zero_mean;
      updateMixture(drawn.statistics, drawn.e, options, &drawn.at);
      ASSERT_NO_THROW(drawn.at.mixture.validate("mixture")) << "shift " << shift;
      EXPECT_LT(drawn.at.mixture.mean().norm(), 1e-8 * (1 + shift));
    }
  }
}

TEST(ZeroMeanOfOneComponent, IsZero) {
  DrawnMixture drawn(1, 2, 30);
  OptimisationOptions options;
  options.constraint = Constraint::zero_mean;
  updateMixture(drawn.statistics, drawn.e, options, &drawn.at);
  EXPECT_EQ(drawn.at.mixture.weights[0], 1);
  EXPECT_EQ(drawn.at.mixture.means[0], VectorXd::Zero(2));
  EXPECT_LT((drawn.at.mixture.covariances[0] - drawn.spreadAround(0, VectorXd::Zero(2))).norm(),
            1e-13);
}

TEST(Floor, LiftsOnlyWhatLiesBelow) {
  DrawnMixture drawn(2, 2, 30);
  OptimisationOptions options;
  options.constraint = Constraint::free;
  updateMixture(drawn.statistics, drawn.e, options, &drawn.at);
  const MatrixXd free = drawn.at.mixture.covariances[0];
  options.floor = 1e-6 * MatrixXd::Identity(2, 2);
  updateMixture(drawn.statistics, drawn.e, options, &drawn.at);
  EXPECT_EQ(drawn.at.mixture.covariances[0], free);

  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(free);
  options.floor = 0.5 * eigen.eigenvalues().sum() * MatrixXd::Identity(2, 2);
  updateMixture(drawn.statistics, drawn.e, options, &drawn.at);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> lifted(drawn.at.mixture.covariances[0]);
  EXPECT_NEAR(lifted.eigenvalues()[0], 0.5 * eigen.eigenvalues().sum(), 1e-12);
  EXPECT_NEAR(lifted.eigenvalues()[1], eigen.eigenvalues()[1], 1e-12);
}

TEST(Floor, IsAShareOfThePooledCovariance) {
  const DrawnMixture drawn(3, 2, 30);
  const MatrixXd pooled = drawn.at.mixture.covariance();
  EXPECT_LT((covarianceFloor(drawn.at.mixture) - 1e-4 * pooled).norm(), 1e-9 * pooled.norm());
  Mixture flat{{1.0}, {VectorXd::Zero(2)}, {MatrixXd::Zero(2, 2)}};
  EXPECT_GT(covarianceFloor(flat).diagonal().minCoeff(), 0);
}

TEST(Prune, BelowAHundredthOfAnEqualShare) {
  Mixture mixture{{0.5, 0.4966, 0.0034},
                  {VectorXd::Constant(1, 1), VectorXd::Constant(1, -1), VectorXd::Constant(1, 9)},
                  std::vector<MatrixXd>(3, MatrixXd::Identity(1, 1))};
  EXPECT_FALSE(pruneComponents(Constraint::free, &mixture));
  EXPECT_EQ(mixture.components(), 3);
  mixture.weights = {0.5, 0.4968, 0.0032};  // 1/300 lies between
  EXPECT_TRUE(pruneComponents(Constraint::free, &mixture));
  ASSERT_EQ(mixture.components(), 2);
  EXPECT_EQ(mixture.means[1][0], -1);
  EXPECT_NEAR(mixture.weights[0] + mixture.weights[1], 1, 1e-15);
  EXPECT_NEAR(mixture.weights[0], 0.5 / 0.9968, 1e-15);
}

TEST(Prune, KeepsZeroMean) {
  Mixture mixture{{0.5, 0.4968, 0.0032},
                  {VectorXd::Constant(1, 1), VectorXd::Constant(1, -1), VectorXd::Constant(1, 9)},
                  std::vector<MatrixXd>(3, MatrixXd::Identity(1, 1))};
  EXPECT_TRUE(pruneComponents(Constraint::zero_mean, &mixture));
  EXPECT_NEAR(mixture.mean()[0], 0, 1e-15);
}

/// Two identical experiments far from all others attract a component. It must not collapse onto
/// them, because the likelihood is unbounded there.
class CollapseGuard : public testing::TestWithParam<bool> {};

TEST_P(CollapseGuard, HoldsComponentsAboveTheFloor) {
  dense::Model truth;
  truth.b = test::vectorOf({1.0});
  truth.a = test::vectorOf({0.5});
  truth.T = Eigen::Vector2d(1, -1);
  truth.basis = dense::firBasis(2, 2);
  truth.basis_order = 1;
  truth.noise_variance = 1e-4;
  truth.mixture = {{1.0}, {VectorXd::Zero(1)}, {MatrixXd::Constant(1, 1, 0.2)}};
  test::RandomSystemOptions options;
  options.experiments = 30;
  options.nc = options.nd = 0;
  auto system = test::simulateSystem(truth, options, 5);
  truth.mixture = {{1.0}, {VectorXd::Constant(1, 8)}, {MatrixXd::Constant(1, 1, 1e-12)}};
  options.experiments = 2;
  for (Experiment& twin : test::simulateSystem(truth, options, 6).experiments) {
    twin.id += "twin";
    system.experiments.push_back(twin);
  }
  const test::CoreSetup setup(test::configurationOf(options), system.experiments);
  ModelParameters start{test::vectorOf({1.0, 0.5}), {}, 1e-4};
  start.mixture = {{0.9, 0.1},
                   {VectorXd::Zero(1), VectorXd::Constant(1, 7)},
                   std::vector<MatrixXd>(2, MatrixXd::Constant(1, 1, 0.5))};
  OptimisationOptions limited;
  limited.constraint = Constraint::zero_static_gain;
  limited.floor = covarianceFloor(start.mixture);
  limited.max_iterations = 300;
  const Optimum optimum = GetParam() ? maximumLikelihood(setup.likelihood(), start, limited)
                                     : expectationMaximisation(setup.likelihood(), start, limited);
  ASSERT_EQ(optimum.point.mixture.components(), 2);
  const double floor = limited.floor(0, 0);
  EXPECT_NEAR(optimum.point.mixture.weights[1], 2.0 / 32, 1e-3);
  EXPECT_NEAR(optimum.point.mixture.means[1][0], 8, 0.1);
  EXPECT_GE(optimum.point.mixture.covariances[1](0, 0), floor * (1 - 1e-9));
  EXPECT_LT(optimum.point.mixture.covariances[1](0, 0), 1.01 * floor) << "what to guard against";
  EXPECT_TRUE(std::isfinite(optimum.log_likelihood));
}

INSTANTIATE_TEST_SUITE_P(BothAlgorithms, CollapseGuard, testing::Bool());

}  // namespace
}  // namespace uncertainty_identification
