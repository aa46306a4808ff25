#include "math/polynomial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>
#include <stdexcept>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::vectorOf;

VectorXd random(int order, double radius, std::uint64_t seed) {
  return test::randomPolynomial(order, radius, seed).tail(order);
}

/// Value at q^-1 = x.
std::complex<double> valueAt(const VectorXd& monic, std::complex<double> x) {
  std::complex<double> sum = 1, power = 1;
  for (Eigen::Index k = 0; k < monic.size(); ++k) sum += monic[k] * (power *= x);
  return sum;
}

TEST(Reflection, RoundTrip) {
  for (int order = 0; order <= 6; ++order) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const VectorXd monic = random(order, 0.95, seed);
      const VectorXd reflection = reflectionCoefficients(monic);
      ASSERT_EQ(reflection.size(), order);
      EXPECT_LT((fromReflection(reflection) - monic).norm(), 1e-10);
      EXPECT_LT((fromUnbounded(toUnbounded(monic)) - monic).norm(), 1e-10);
    }
  }
}

TEST(Reflection, KnownCoefficients) {
  // 1 + k1 (1 + k2) q^-1 + k2 q^-2
  EXPECT_LT((fromReflection(vectorOf({0.5, -0.2})) - vectorOf({0.4, -0.2})).norm(), 1e-15);
}

TEST(Reflection, BreaksDownOnTheUnitCircle) {
  EXPECT_TRUE(std::isnan(reflectionCoefficients(vectorOf({0.3, 1.0}))[0]));
  EXPECT_THROW(toUnbounded(vectorOf({0.3, 1.0})), std::domain_error);
  EXPECT_THROW(toUnbounded(vectorOf({-1.1})), std::domain_error);
}

TEST(Reflection, JacobiansMatchDifferences) {
  for (int order = 1; order <= 5; ++order) {
    const VectorXd at = 0.8 * VectorXd::Random(order);
    MatrixXd of_reflection, of_unbounded;
    fromReflection(at, &of_reflection);
    fromUnbounded(at, &of_unbounded);
    const auto reflection = [](const VectorXd& k) { return fromReflection(k); };
    const auto unbounded = [](const VectorXd& z) { return fromUnbounded(z); };
    EXPECT_LT((of_reflection - test::differences(reflection, at)).norm(), 1e-9) << order;
    EXPECT_LT((of_unbounded - test::differences(unbounded, at)).norm(), 1e-9) << order;
  }
}

TEST(Unbounded, AnyVectorGivesAFinitePolynomialInsideTheCircle) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal(0, 8);
  for (int order = 1; order <= 4; ++order) {
    for (int draw = 0; draw < 200; ++draw) {
      VectorXd z(order);
      for (Eigen::Index k = 0; k < order; ++k) z[k] = normal(engine);
      const VectorXd monic = fromUnbounded(z);
      ASSERT_TRUE(monic.allFinite());
      // the roots of a polynomial of order n move by the n-th root of the rounding
      EXPECT_LT(roots(monic).cwiseAbs().maxCoeff(), 1 + std::pow(1e-13, 1.0 / order))
          << z.transpose();
    }
  }
}

TEST(IsStable, AtARadius) {
  EXPECT_TRUE(isStable(vectorOf({-0.9}), 0.901));
  EXPECT_FALSE(isStable(vectorOf({-0.9}), 0.899));
  const double r = 0.8, angle = 1.1;
  const VectorXd pair = vectorOf({-2 * r * std::cos(angle), r * r});
  EXPECT_TRUE(isStable(pair, 0.801));
  EXPECT_FALSE(isStable(pair, 0.799));
  EXPECT_TRUE(isStable(VectorXd()));
  EXPECT_FALSE(isStable(vectorOf({std::nan("")})));
  EXPECT_FALSE(isStable(vectorOf({1.0})));
  EXPECT_FALSE(isStable(vectorOf({0.0, 1.0})));
}

/// Five per cent are left after n samples of a root of radius 0.05^(1/n).
TEST(Polynomial, OscillationsDecayWhereTheirRootsAreInside) {
  const double radius = std::pow(0.05, 1.0 / 100);
  const auto pair = [](double r) { return vectorOf({-2 * r * std::cos(0.3), r * r}); };
  EXPECT_TRUE(oscillationsDecay(pair(radius * 0.999), 100));
  EXPECT_FALSE(oscillationsDecay(pair(radius * 1.001), 100));
  EXPECT_FALSE(oscillationsDecay(vectorOf({0.99}), 100));  // alternates
  EXPECT_TRUE(oscillationsDecay(vectorOf({-1.0}), 100));   // integrates
  EXPECT_TRUE(oscillationsDecay(VectorXd(), 100));
}

TEST(Polynomial, AnOscillationLastsWhereItKeepsNineTenths) {
  const auto frequency = [](double r, double samples) {
    return lastingFrequency(vectorOf({-2 * r * std::cos(0.3), r * r}), samples);
  };
  EXPECT_NEAR(frequency(std::pow(0.91, 1e-3), 1000), 0.3, 1e-9);
  EXPECT_EQ(frequency(std::pow(0.89, 1e-3), 1000), 0);
  EXPECT_NEAR(frequency(std::pow(1.1, 1e-3), 1000), 0.3, 1e-9);
  EXPECT_EQ(frequency(std::pow(1.13, 1e-3), 1000), 0) << "rises";
  EXPECT_EQ(frequency(1, 200), 0) << "less than ten periods";
}

TEST(IsStable, AgreesWithTheRoots) {
  int stable = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const VectorXd monic = random(4, 1.3, seed);
    const double largest = roots(monic).cwiseAbs().maxCoeff();
    EXPECT_EQ(isStable(monic), largest < 1) << monic.transpose();
    stable += largest < 1 ? 1 : 0;
  }
  EXPECT_GT(stable, 20);
  EXPECT_LT(stable, 180);
}

TEST(Roots, AreZerosOfThePolynomial) {
  const VectorXd monic = random(5, 0.9, 7);
  for (const std::complex<double> root : listOfRoots(monic)) {
    EXPECT_LT(std::abs(valueAt(monic, 1.0 / root)), 1e-9);
  }
  EXPECT_EQ(roots(VectorXd()).size(), 0);
}

TEST(Stabilised, MirrorsRootsAtTheUnitCircle) {
  EXPECT_LT((stabilised(vectorOf({-2.0})) - vectorOf({-0.5})).norm(), 1e-14);
  const double r = 1.25, angle = 0.7;
  const VectorXd outside = vectorOf({-2 * r * std::cos(angle), r * r});
  const VectorXd inside = vectorOf({-2 / r * std::cos(angle), 1 / (r * r)});
  EXPECT_LT((stabilised(outside) - inside).norm(), 1e-12);
  const VectorXd mixed = multiply(outside, vectorOf({0.4}));
  EXPECT_LT((stabilised(mixed) - multiply(inside, vectorOf({0.4}))).norm(), 1e-12);
}

TEST(Stabilised, DrawsRootsOnTheCircleIn) {
  EXPECT_LT((stabilised(vectorOf({-1.0}), 0.99) - vectorOf({-0.99})).norm(), 1e-12);
  EXPECT_TRUE(isStable(stabilised(vectorOf({0.0, 1.0}), 0.99), 0.9901));
}

TEST(Stabilised, LeavesStablePolynomialsAlone) {
  const VectorXd monic = random(4, 0.95, 3);
  EXPECT_EQ(stabilised(monic), monic);
}

TEST(Multiply, IsAConvolution) {
  EXPECT_EQ(multiply(vectorOf({2}), vectorOf({3, 5})), vectorOf({5, 11, 10}));
  EXPECT_EQ(multiply(VectorXd(), vectorOf({3, 5})), vectorOf({3, 5}));
  EXPECT_EQ(multiply(vectorOf({3, 5}), VectorXd()), vectorOf({3, 5}));
}

}  // namespace
}  // namespace uncertainty_identification
