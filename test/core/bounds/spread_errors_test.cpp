#include "bounds/spread_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/distributions.h"
#include "math/random_stream.h"
#include "support/core_setup.h"
#include "uncertainty_identification/math/mixture_coordinates.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::vectorOf;

constexpr int kExperiments = 8;

/// A single component in one dimension with standard deviation 1, whose error is `times` the one
/// that experiments without noise leave, drawn `z` standard deviations too large.
double drawnDeviation(double z, double times, int experiments = kExperiments) {
  const double deviation = times / std::sqrt(2.0 * kExperiments);
  const Mixture mixture{{1.0}, {VectorXd::Zero(1)}, {MatrixXd::Identity(1, 1)}};
  const SpreadErrors errors(mixture, MatrixXd::Constant(1, 1, deviation * deviation), experiments);
  VectorXd coordinates = vectorOf({1 + z * deviation});
  errors.replaceRoots(vectorOf({1.0}), &coordinates);
  return coordinates[0];
}

/// sqrt(8 / chi2.ppf(p, 7)) of scipy.stats at p = 0.025, 0.5, 0.975.
TEST(SpreadErrors, AreThoseOfTheChiSquaredDistribution) {
  const double z = normalTailQuantile(0.025);
  EXPECT_NEAR(drawnDeviation(z, 1), 2.175797, 1e-5);
  EXPECT_NEAR(drawnDeviation(0, 1), 1.122797, 1e-5);
  EXPECT_NEAR(drawnDeviation(-z, 1), 0.706825, 1e-5);
}

TEST(SpreadErrors, StayFiniteHoweverFarTheErrorIs) {
  for (const double z : {-60.0, -9.0, 9.0, 60.0}) {
    const double deviation = drawnDeviation(z, 1);
    EXPECT_TRUE(std::isfinite(deviation)) << z;
    EXPECT_EQ(deviation, drawnDeviation(z < 0 ? -7 : 7, 1)) << z;
  }
}

/// Noise of variance 2 beside the plants' 1 makes the error of the estimated variance three times
/// as large: 3 * 8/chi2 - 2, or zero.
TEST(SpreadErrors, GrowWithTheNoise) {
  const double z = normalTailQuantile(0.025);
  EXPECT_NEAR(drawnDeviation(z, 3), std::sqrt(3 * 2.175797 * 2.175797 - 2), 1e-5);
  EXPECT_EQ(drawnDeviation(-z, 3), 0);
}

TEST(SpreadErrors, StayGaussianWhereTheNumberOfExperimentsIsUnknown) {
  EXPECT_EQ(drawnDeviation(2, 1, 0), 1 + 2 / std::sqrt(2.0 * kExperiments));
}

/// The sum of the covariance's posterior and a normal distribution is Student's: x' S^-1 x
/// (M - n)/(M n) has an F distribution with n and M - n degrees of freedom.
TEST(SpreadErrors, OfSeveralDimensionsGiveStudentsDistribution) {
  constexpr int kDraws = 20000, kCount = 10;
  const MatrixXd root = lowerTriangle(vectorOf({2.0, -1.0, 0.5}), 2);
  const Mixture mixture{{1.0}, {VectorXd::Zero(2)}, {root * root.transpose()}};
  const double half = 1 / (2.0 * kCount);
  MatrixXd to_root(3, 3);  // from the entries of L^-1 dL to those of dL
  for (int k = 0; k < 3; ++k)
    to_root.col(k) = lowerEntries(root * lowerTriangle(VectorXd::Unit(3, k), 2));
  const VectorXd standard = vectorOf({half, 2 * half, half}).cwiseSqrt();
  const MatrixXd covariance = to_root * standard.cwiseAbs2().asDiagonal() * to_root.transpose();
  const SpreadErrors errors(mixture, covariance, kCount);
  const VectorXd center = lowerEntries(root);
  std::mt19937_64 random = randomStream(1, 0, RandomPurpose::plant);
  const double limit = fisherTail(4.0, 2, kCount - 2);  // share beyond F = 4
  int beyond = 0;
  for (int i = 0; i < kDraws; ++i) {
    VectorXd drawn = center + to_root * standard.cwiseProduct(VectorXd(gaussian(3, 1, random)));
    errors.replaceRoots(center, &drawn);
    const VectorXd x = lowerTriangle(drawn, 2) * gaussian(2, 1, random);
    const double squared = root.triangularView<Eigen::Lower>().solve(x).squaredNorm();
    beyond += squared * (kCount - 2) / (kCount * 2.0) > 4.0;
  }
  EXPECT_NEAR(beyond / static_cast<double>(kDraws), limit, 4 * std::sqrt(limit / kDraws));
}

}  // namespace
}  // namespace uncertainty_identification
