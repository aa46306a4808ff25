#include "support/random_system.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

namespace uncertainty_identification {
namespace {

double largestRoot(const Eigen::VectorXd& polynomial) {
  const Eigen::Index order = polynomial.size() - 1;
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(order, order);
  companion.row(0) = -polynomial.tail(order).transpose();
  companion.diagonal(-1).setOnes();
  return companion.eigenvalues().cwiseAbs().maxCoeff();
}

TEST(RandomSystem, RootsLieWithinTheRadius) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    for (int order = 1; order <= 5; ++order) {
      const auto polynomial = test::randomPolynomial(order, 0.9, seed);
      ASSERT_EQ(polynomial.size(), order + 1);
      EXPECT_LE(largestRoot(polynomial), 0.9 + 1e-9);
    }
  }
}

TEST(RandomSystem, SameSeedSameSystem) {
  test::RandomSystemOptions options;
  options.experiments = 2;
  const auto one = test::randomSystem(options, 4), two = test::randomSystem(options, 4);
  const auto other = test::randomSystem(options, 5);
  EXPECT_EQ(one.truth.a, two.truth.a);
  EXPECT_EQ(one.experiments[1].y, two.experiments[1].y);
  EXPECT_NE(one.truth.a, other.truth.a);
}

TEST(RandomSystem, DropsTheShareAskedFor) {
  test::RandomSystemOptions options;
  options.missing = 0.2;
  for (const auto& experiment : test::randomSystem(options, 6).experiments) {
    int missing = 0;
    for (int k = 0; k < experiment.samples(); ++k) {
      if (experiment.isValid(k)) {
        EXPECT_TRUE(std::isfinite(experiment.y[k]));
      } else {
        ++missing;
        EXPECT_TRUE(std::isnan(experiment.y[k]));
      }
    }
    EXPECT_EQ(missing, std::lround(0.2 * experiment.samples()));
  }
}

/// Data drawn from a system are likelier under it than under its neighbours.
TEST(RandomSystem, TruthIsLikelierThanItsNeighbours) {
  test::RandomSystemOptions options;
  options.nb = options.na = options.nc = options.nd = 2;
  options.delay = 2;
  options.taps = 3;
  options.laguerre_pole = 0.4;
  options.missing = 0.1;
  options.noise_run_up = 2000;
  options.experiments = 30;
  const auto system = test::randomSystem(options, 11);
  dense::Options stationary;
  stationary.noise_start = NoiseStart::stationary;
  const double at_truth = dense::logLikelihood(system.experiments, system.truth, stationary);
  const auto expectLess = [&](const dense::Model& neighbour, const char* what) {
    EXPECT_LT(dense::logLikelihood(system.experiments, neighbour, stationary), at_truth) << what;
  };
  for (const double step : {-0.15, 0.15}) {
    for (auto member : {&dense::Model::b, &dense::Model::a, &dense::Model::c, &dense::Model::d}) {
      dense::Model neighbour = system.truth;
      (neighbour.*member)[1] += step;
      expectLess(neighbour, "polynomial");
    }
    dense::Model neighbour = system.truth;
    neighbour.noise_variance *= std::exp(step);
    expectLess(neighbour, "noise variance");
    neighbour = system.truth;
    for (auto& mean : neighbour.mixture.means) mean[0] += 2 * step;
    expectLess(neighbour, "means");
  }
}

}  // namespace
}  // namespace uncertainty_identification
