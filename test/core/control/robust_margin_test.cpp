// Loops whose margin and probability of instability are known by hand.
#include "uncertainty_identification/control/robust_margin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>

#include "math/polynomial.h"
#include "simulation/simulate.h"
#include "support/core_setup.h"
#include "support/error_message.h"
#include "support/faults.h"
#include "support/monte_carlo.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::vectorOf;

constexpr double kSampleTime = 0.1;  // [s]
constexpr int kSamples = 10000;

/// Go = q^-delay B/A with the relative error eta ~ N(0, variance), a constant.
Estimate plant(const VectorXd& b, const VectorXd& a, int delay, double variance) {
  Estimate estimate;
  estimate.nominal_model.sample_time = kSampleTime;
  estimate.nominal_model.delay = delay;
  estimate.nominal_model.b = b;
  estimate.nominal_model.a = a;
  estimate.error_model.options.taps = 1;
  estimate.error_model.options.constraint = Constraint::free;
  estimate.error_model.T = MatrixXd::Identity(1, 1);
  estimate.error_model.mixture = {{1}, {VectorXd::Zero(1)}, {MatrixXd::Constant(1, 1, variance)}};
  return estimate;
}

RobustMargin marginOf(const Estimate& estimate, const RationalFunction& weight,
                      const RationalFunction& controller) {
  RobustMarginOptions options;
  options.controller = controller;
  options.samples = kSamples;
  return robustMargin(PlantDistribution(estimate), weight, options);
}

RationalFunction constant(double value) { return {vectorOf({value}), vectorOf({1})}; }

// L = 1/2 q^-1: T = 1/2 q^-1/(1 + 1/2 q^-1) is largest at the Nyquist frequency, (1/2)/(1/2) = 1.
TEST(RobustMargin, ProportionalControlOfADelay) {
  const auto found = marginOf(plant(vectorOf({1}), {}, 1, 0.25), constant(0.8), constant(0.5));
  EXPECT_TRUE(found.nominal_stable);
  EXPECT_NEAR(found.peak, 0.8, 1e-12);
  EXPECT_NEAR(found.margin, 1.25, 1e-12);
  EXPECT_NEAR(found.peak_omega, M_PI / kSampleTime, 1e-6);
  EXPECT_TRUE(found.robust());
  // Unstable where |1 + eta| > 2: eta > 1 or eta < -3 at a standard deviation of 1/2.
  const double expected = 0.5 * std::erfc(2 / std::sqrt(2.0)) + 0.5 * std::erfc(6 / std::sqrt(2.0));
  EXPECT_NEAR(found.unstable_probability, expected, 3 * found.unstable_error);
  EXPECT_NEAR(found.unstable_error, std::sqrt(expected * (1 - expected) / kSamples), 2e-4);
  EXPECT_GT(found.unstable_upper, found.unstable_probability);
  EXPECT_LT(found.unstable_upper, found.unstable_probability + 2 * found.unstable_error);
  EXPECT_EQ(found.samples, kSamples);
}

// K = 1/2 /(1 - q^-1) on a delay: T = 1/2 q^-1/(1 - 1/2 q^-1) is 1 at zero frequency.
TEST(RobustMargin, AnIntegratorIsAllowed) {
  const RationalFunction integral{vectorOf({0.5}), vectorOf({1, -1})};
  const auto found = marginOf(plant(vectorOf({1}), {}, 1, 0.01), constant(0.5), integral);
  EXPECT_NEAR(found.peak, 0.5, 1e-12);
  EXPECT_NEAR(found.margin, 2, 1e-12);
  EXPECT_NEAR(found.peak_omega, 0, 1e-6);
  // Unstable where 1 - 0.5 (1 + eta) leaves (-1, 1): beyond eta = -1 or 3, ten deviations.
  EXPECT_EQ(found.unstable_probability, 0);
  EXPECT_NEAR(found.unstable_upper, 1 - std::pow(0.05, 1.0 / kSamples), 1e-9);  // rule of three
}

// W = (1 - 0.5 q^-1): |W T| = |1/2 q^-1| |1 - 0.5 q^-1|/|1 - 0.5 q^-1| = 1/2 everywhere.
TEST(RobustMargin, TheWeightIsPartOfTheLoop) {
  const RationalFunction integral{vectorOf({0.5}), vectorOf({1, -1})};
  const RationalFunction weight{vectorOf({1, -0.5}), vectorOf({1})};
  EXPECT_NEAR(marginOf(plant(vectorOf({1}), {}, 1, 0.01), weight, integral).peak, 0.5, 1e-12);
  // ... and divided by (1 + 0.2 q^-1): largest at the Nyquist frequency, 0.5/0.8.
  const RationalFunction filtered{vectorOf({2, -1}), vectorOf({2, 0.4})};
  EXPECT_NEAR(marginOf(plant(vectorOf({1}), {}, 1, 0.01), filtered, integral).peak, 0.625, 1e-12);
}

TEST(RobustMargin, AnUnstableNominalLoopHasNone) {
  const auto found = marginOf(plant(vectorOf({1}), {}, 1, 0.01), constant(0.5), constant(1.2));
  EXPECT_FALSE(found.nominal_stable);
  EXPECT_FALSE(found.robust());
  EXPECT_EQ(found.margin, 0);
  // Stable where 1.2 (1 + eta) < 1: eta < -1/6 at a deviation of 0.1.
  EXPECT_NEAR(found.unstable_probability, 1 - 0.5 * std::erfc(1 / 0.6 / std::sqrt(2.0)), 0.01);
}

TEST(RobustMargin, AMarginBelowOneIsNoGuarantee) {
  const auto found = marginOf(plant(vectorOf({1}), {}, 1, 0.01), constant(1.5), constant(0.5));
  EXPECT_NEAR(found.margin, 1 / 1.5, 1e-12);
  EXPECT_FALSE(found.robust());
}

// A closed loop with poles r e^(+-j phi) next to the circle: |T| at its peak by the closed form of
// a second-order resonance, min over w of |1 - r e^(j(phi - w))| |1 - r e^(-j(phi + w))|, which for
// cos w = cos phi (1 + r^2)/(2 r) is (1 - r^2) sin phi.
TEST(RobustMargin, FindsANarrowPeak) {
  for (const double r : {0.99, 0.9999, 0.999999}) {
    const double phi = 1.2345;
    // A + q^-1 B K = the wanted polynomial with K = 1, A = 1: B = [-2 r cos phi, r^2].
    const VectorXd b = vectorOf({-2 * r * std::cos(phi), r * r});
    const auto found = marginOf(plant(b, {}, 1, 1e-20), constant(1), constant(1));
    const double omega = std::acos(std::cos(phi) * (1 + r * r) / (2 * r));
    const std::complex<double> z_inverse = std::polar(1.0, -omega);
    const double numerator = std::abs(b[0] + b[1] * z_inverse);
    EXPECT_NEAR(found.peak / (numerator / ((1 - r * r) * std::sin(phi))), 1, 1e-3) << r;
    EXPECT_NEAR(found.peak_omega * kSampleTime, omega, 0.02 * (1 - r)) << r;
  }
}

// Recursive basis and more taps: the polynomial's roots are the poles of the simulated loop.
TEST(RobustMargin, CharacteristicPolynomialsHoldTheErrorModel) {
  PlantSamples plants;
  plants.sample_time = kSampleTime;
  plants.delay = 2;
  plants.b = MatrixXd(1, 2);
  plants.b << 1, 0.3;
  plants.a = MatrixXd::Constant(1, 1, -0.5);
  plants.eta = MatrixXd(1, 2);
  plants.eta << 0.4, -0.2;
  plants.basis.basis = BasisKind::laguerre;
  plants.basis.taps = 2;
  plants.basis.pole = 0.6;
  const RationalFunction controller{vectorOf({0.7, -0.1}), vectorOf({2, -2})};
  const VectorXd found = characteristicPolynomials(plants, controller).row(0).transpose();
  ASSERT_EQ(found.size(), 6);  // delay + nb - 1 + order of the basis + nc: 2 + 1 + 2 + 1
  const ErrorBasis basis(plants.basis);
  for (const std::complex<double> root : listOfRoots(found)) {
    const std::complex<double> w = 1.0 / root;
    const std::complex<double> go = w * w * (1.0 + 0.3 * w) / (1.0 - 0.5 * w);
    const std::complex<double> error =
        1.0 + (plants.eta.row(0).transpose().cast<std::complex<double>>().cwiseProduct(
                   basis.responses(w)))
                  .sum();
    const std::complex<double> k = (0.7 - 0.1 * w) / (2.0 - 2.0 * w);
    EXPECT_LT(std::abs(1.0 + go * error * k), 1e-8) << root;
  }
}

// Example 1 with its true model; scripts/study_robust_margin is the long form.
TEST(RobustMargin, TheProbabilityIsTheShareOfTrueSystems) {
  constexpr int kSystems = 4000;
  const Truth truth = test::example1Truth();
  const PlantDistribution plants(test::estimateOf(truth));
  const ErrorBasis basis(truth.error_model.basis);
  PlantSamples systems = plants.draw(kSystems, Uncertainty::mixture, 2);
  for (int r = 0; r < kSystems; ++r)
    systems.eta.row(r) = (basis.T() * drawSystem(truth, 3, r).xi).transpose();
  for (const double gain : {0.2, 0.5, 2.0}) {
    RobustMarginOptions options;
    options.controller = {vectorOf({gain}), vectorOf({1, -1})};
    const auto found = robustMargin(plants, constant(4), options);
    const MatrixXd all = characteristicPolynomials(systems, options.controller);
    double unstable = 0;
    for (int r = 0; r < kSystems; ++r) unstable += isStable(all.row(r).transpose()) ? 0 : 1;
    const double share = found.unstable_probability;
    EXPECT_NEAR(unstable / kSystems, share, 4 * std::sqrt(share * (1 - share) / kSystems)) << gain;
  }
}

TEST(RobustMargin, RefusesWhatIsNoController) {
  const auto refusal = [](const VectorXd& num, const VectorXd& den) {
    return messageOf<ConfigurationError>([&] { requireController({num, den}); });
  };
  const std::string none = "no exception";
  EXPECT_EQ(refusal(vectorOf({1}), vectorOf({1})), none);
  EXPECT_EQ(refusal(vectorOf({1}), vectorOf({1, -2, 1})), none) << "a double integrator";
  EXPECT_EQ(refusal(vectorOf({1}), vectorOf({1, 0, 1})), none) << "a resonance on the circle";
  EXPECT_NE(refusal(vectorOf({1}), vectorOf({1, -1.1}))
                .find("controller.den: found a pole of "
                      "magnitude 1.1; allowed: up to 1"),
            std::string::npos);
  EXPECT_NE(refusal(vectorOf({1}), vectorOf({0, 1})).find("the first not zero"), std::string::npos);
  EXPECT_NE(refusal(vectorOf({1}), VectorXd()).find("controller.den"), std::string::npos);
  EXPECT_NE(refusal(vectorOf({0, 0}), vectorOf({1})).find("controller.num"), std::string::npos);
  EXPECT_NE(refusal(vectorOf({std::nan("")}), vectorOf({1})).find("controller.num"),
            std::string::npos);
}

TEST(RobustMargin, RefusesAlgebraicLoopsAndUnstableWeights) {
  const Estimate direct = plant(vectorOf({1}), {}, 0, 0.01);
  EXPECT_NE(messageOf<ConfigurationError>([&] {
              marginOf(direct, constant(0.5), constant(-1));
            }).find("algebraic loop"),
            std::string::npos);
  EXPECT_NO_THROW(marginOf(direct, constant(0.5), constant(0.5)));
  const RationalFunction unstable{vectorOf({1}), vectorOf({1, -1.5})};
  EXPECT_NE(messageOf<DataError>([&] {
              marginOf(plant(vectorOf({1}), {}, 1, 0.01), unstable, constant(0.5));
            }).find("W(z)"),
            std::string::npos);
}

}  // namespace
}  // namespace uncertainty_identification
