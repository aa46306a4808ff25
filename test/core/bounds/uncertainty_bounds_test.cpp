#include "uncertainty_identification/bounds/uncertainty_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "support/core_setup.h"
#include "support/plain_estimate.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using test::vectorOf;

double normal(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// Probability that |1 + 2 xi| <= m, which is |G/Go| at the Nyquist frequency for 1 - q^-1.
double shareBelow(double m) {
  double share = 0;
  for (double mean : {-1.0, 1.0}) {
    const double deviation = 2 * std::sqrt(0.2), center = 1 + 2 * mean;
    share += 0.5 * (normal((m - center) / deviation) - normal((-m - center) / deviation));
  }
  return share;
}

BoundsOptions manySamples() {
  BoundsOptions options;
  options.samples = 50000;
  return options;
}

TEST(FrequencyBounds, OfTheMixtureAreItsQuantiles) {
  const PlantDistribution plants(test::plainEstimate(vectorOf({1.0}), vectorOf({0.5})));
  const VectorXd nyquist = vectorOf({std::acos(-1.0) / 0.1});
  const FrequencyBounds bounds = frequencyBounds(plants, nyquist, manySamples(), 1);
  EXPECT_NEAR(bounds.magnitude[0], 2, 1e-12);
  for (const Band& band : bounds.magnitude_bands.mixture.pointwise) {
    const double tail = (1 - band.level) / 2;
    const double error = 4 * std::sqrt(tail * (1 - tail) / 50000);
    EXPECT_NEAR(shareBelow(band.upper[0] / 2), 1 - tail, error);
    EXPECT_NEAR(shareBelow(band.lower[0] / 2), tail, error);
  }
  const Band& error = bounds.relative_error.mixture.pointwise[2];  // |2 xi|
  EXPECT_NEAR(0.5 * (normal((error.upper[0] / 2 - 1) / std::sqrt(0.2)) +
                     normal((error.upper[0] / 2 + 1) / std::sqrt(0.2)) -
                     normal((-error.upper[0] / 2 - 1) / std::sqrt(0.2)) -
                     normal((-error.upper[0] / 2 + 1) / std::sqrt(0.2))),
              0.95, 4 * std::sqrt(0.05 * 0.95 / 50000));
}

/// Without an error model magnitude and phase are normal to first order: the delta method.
TEST(FrequencyBounds, OfTheEstimateAreTheDeltaMethods) {
  const double error = 1e-6, a = -0.8;
  const PlantDistribution plants(
      test::estimateWithoutErrorModel(vectorOf({0.5}), vectorOf({a}), error));
  const VectorXd omega = vectorOf({0.5, 5.0});
  const FrequencyBounds bounds = frequencyBounds(plants, omega, manySamples(), 1);
  for (Eigen::Index k = 0; k < omega.size(); ++k) {
    const std::complex<double> shift = std::polar(1.0, -omega[k] * 0.1);
    // d log G = db/b - q^-1/A da, da = (1 - a^2) dz
    const std::complex<double> slope = -shift / (1.0 + a * shift) * (1 - a * a);
    const double magnitude = std::sqrt(error * (4 + slope.real() * slope.real()));
    const double phase = std::sqrt(error) * std::abs(slope.imag());
    const Band& band = bounds.magnitude_bands.total.pointwise[2];
    EXPECT_NEAR(std::log(band.upper[k] / bounds.magnitude[k]), 1.96 * magnitude, 0.03 * magnitude);
    EXPECT_NEAR(std::log(band.lower[k] / bounds.magnitude[k]), -1.96 * magnitude, 0.03 * magnitude);
    const Band& turned = bounds.phase_bands.total.pointwise[2];
    EXPECT_NEAR(turned.upper[k] - bounds.phase[k], 1.96 * phase, 0.03 * phase);
    EXPECT_NEAR(bounds.phase[k], std::arg(shift * 0.5 / (1.0 + a * shift)), 1e-9);
  }
  EXPECT_NEAR(bounds.magnitude_bands.mixture.pointwise[2].upper[0] / bounds.magnitude[0], 1, 1e-5);
}

TEST(FrequencyBounds, RefuseFrequenciesAboveNyquist) {
  const PlantDistribution plants(test::plainEstimate(vectorOf({1.0}), vectorOf({0.5})));
  try {
    frequencyBounds(plants, vectorOf({1.0, 32.0}), BoundsOptions(), 1);
    FAIL();
  } catch (const ConfigurationError& error) {
    EXPECT_NE(std::string(error.what()).find("bounds.grid: found 32"), std::string::npos)
        << error.what();
  }
}

TEST(FrequencyBounds, WithoutKnownErrorsAreOfTheMixtureAlone) {
  Estimate estimate = test::plainEstimate(vectorOf({1.0}), vectorOf({0.5}));
  estimate.joint_covariance.resize(0, 0);
  const FrequencyBounds bounds =
      frequencyBounds(PlantDistribution(estimate), vectorOf({1.0}), BoundsOptions(), 1);
  EXPECT_TRUE(bounds.magnitude_bands.total.empty());
  EXPECT_EQ(bounds.magnitude_bands.mixture.pointwise.size(), 4u);
}

/// (1 - q^-1) xi on a step: xi at the first sample behind the delay, nothing once settled.
TEST(StepBounds, FollowTheErrorModel) {
  const PlantDistribution plants(test::plainEstimate(vectorOf({1.0}), vectorOf({-0.5})));
  const StepBounds bounds = stepBounds(plants, manySamples(), 1);
  const Eigen::Index last = bounds.time.size() - 1;
  EXPECT_NEAR(bounds.time[last], 0.1 * static_cast<double>(last), 1e-12);
  EXPECT_NEAR(bounds.nominal[last], 2, 0.01);
  const Band& band = bounds.bands.mixture.pointwise[2];
  EXPECT_NEAR(band.upper[0], 0, 1e-3);
  const double upper = band.upper[1] - 1;  // xi's 97.5 % point
  EXPECT_NEAR(0.5 * (normal((upper - 1) / std::sqrt(0.2)) + normal((upper + 1) / std::sqrt(0.2))),
              0.975, 4 * std::sqrt(0.025 * 0.975 / 50000));
  EXPECT_NEAR(band.upper[last] - band.lower[last], 0, 0.01);
}

}  // namespace
}  // namespace uncertainty_identification
