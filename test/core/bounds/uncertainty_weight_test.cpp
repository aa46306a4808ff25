#include "uncertainty_identification/bounds/uncertainty_weight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "bounds/frequency_grid.h"
#include "bounds/magnitude_fit.h"
#include "math/polynomial.h"
#include "support/core_setup.h"
#include "support/plain_estimate.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::ArrayXd;
using Eigen::VectorXd;
using test::vectorOf;

VectorXd logSpaced(double low, double high, int count) {
  return VectorXd::LinSpaced(count, std::log(low), std::log(high)).array().exp();
}

/// A rational bound of the fit's order is reproduced at all frequencies.
TEST(FitAbove, FindsARationalBoundAgain) {
  const MinimumPhase truth{0.3, vectorOf({-1.9, 0.905}), vectorOf({-1.1, 0.6})};
  const VectorXd angles = logSpaced(1e-3, 3.14, 200);
  const VectorXd bound = truth.logMagnitude(angles);
  const MinimumPhase first = fitAbove(angles, bound, 1, fitAbove(angles, bound, 0, {}));
  const MinimumPhase fit = fitAbove(angles, bound, 2, first);
  const ArrayXd excess = fit.logMagnitude(angles) - bound.array();
  EXPECT_GE(excess.minCoeff(), -1e-12);
  EXPECT_LT(excess.maxCoeff(), 0.01);
  EXPECT_LT(excess.mean(), (first.logMagnitude(angles) - bound.array()).mean());
}

/// Roots on the unit circle, which can result from rounding, give no start for a higher order.
TEST(FitAbove, KeepsTheLowerOrderWhereNoStartIsStable) {
  const VectorXd angles = logSpaced(1e-3, 3.14, 50), bound = VectorXd::Zero(50);
  const MinimumPhase lower{1, vectorOf({-0.5}), vectorOf({-1.0})};
  EXPECT_EQ(fitAbove(angles, bound, 2, lower).order(), 1);
}

UncertaintyWeight weightOf(const Estimate& estimate, const BoundsOptions& options = {}) {
  return uncertaintyWeight(PlantDistribution(estimate), frequencyGrid(estimate.nominal_model, 500),
                           options, 1);
}

TEST(UncertaintyWeight, CoversItsShareOfFreshPlants) {
  const Estimate estimate = test::plainEstimate(vectorOf({1.0}), vectorOf({0.5}), 1e-5);
  const UncertaintyWeight weight = weightOf(estimate);
  EXPECT_TRUE(isStable(VectorXd(weight.den.tail(weight.order))));
  EXPECT_TRUE(isStable(VectorXd(weight.num.tail(weight.order) / weight.num[0])));
  EXPECT_GE(weight.margin, 1);
  EXPECT_LE(weight.order, 4);
  EXPECT_LE(weight.over_bounding_median, 1.15);
  EXPECT_GE(weight.level_held, 0.95);

  // other plants, other frequencies
  const PlantDistribution plants(estimate);
  const PlantSamples fresh = plants.draw(4000, Uncertainty::total, 99);
  const VectorXd omega = logSpaced(weight.omega[0], std::acos(-1.0) / 0.1, 1234);
  const ComplexResponses all = frequencyResponses(fresh, omega);
  const ComplexResponses go = frequencyResponses(plants.nominal(), omega);
  const ArrayXd limit = magnitudeOf(weight, omega, 0.1);
  int inside = 0;
  for (int i = 0; i < fresh.count(); ++i) {
    bool below = true;
    for (Eigen::Index k = 0; k < omega.size() && below; ++k) {
      const std::complex<double> nominal(go.real(0, k), go.imaginary(0, k));
      const std::complex<double> ratio =
          std::complex<double>(all.real(i, k), all.imaginary(i, k)) / nominal;
      below = std::abs(ratio - 1.0) <= limit[k];
    }
    inside += below;
  }
  // the limit is itself found from 2000 draws: two variances
  EXPECT_GE(inside / 4000.0, 0.95 - 3 * std::sqrt(0.95 * 0.05 * (1.0 / 4000 + 1.0 / 2000)));
}

TEST(UncertaintyWeight, HasATustinTwin) {
  const UncertaintyWeight weight =
      weightOf(test::plainEstimate(vectorOf({1.0}), vectorOf({0.5}), 1e-5));
  const auto at = [](const VectorXd& descending, std::complex<double> x) {
    std::complex<double> value = 0;
    for (Eigen::Index k = 0; k < descending.size(); ++k) value = value * x + descending[k];
    return value;
  };
  const VectorXd omega = vectorOf({0.05, 1.0, 10.0, 25.0});
  const ArrayXd discrete = magnitudeOf(weight, omega, 0.1);
  for (Eigen::Index k = 0; k < omega.size(); ++k) {
    const std::complex<double> s(0, 2 / 0.1 * std::tan(omega[k] * 0.1 / 2));
    const double twin = std::abs(at(weight.continuous_num, s) / at(weight.continuous_den, s));
    EXPECT_NEAR(twin, discrete[k], 1e-9 * discrete[k]);
  }
}

TEST(UncertaintyWeight, TakesTheOrderAskedFor) {
  BoundsOptions options;
  options.weight_order = 0;
  const Estimate estimate = test::plainEstimate(vectorOf({1.0}), vectorOf({0.5}), 1e-5);
  const UncertaintyWeight constant = weightOf(estimate, options);
  EXPECT_EQ(constant.order, 0);
  EXPECT_NEAR(constant.num[0], constant.bound.maxCoeff(), 0.01 * constant.num[0]);
  options.weight_order = 3;
  EXPECT_EQ(weightOf(estimate, options).order, 3);
}

/// Without estimation errors |GDelta| tends to zero at low frequency, and the floor of the bound
/// applies.
TEST(UncertaintyWeight, KeepsAFloor) {
  Estimate estimate = test::plainEstimate(vectorOf({1.0}), vectorOf({0.5}));
  estimate.joint_covariance.resize(0, 0);
  const UncertaintyWeight weight = weightOf(estimate);
  EXPECT_LT(weight.bound[0], weight.floor * 2);
  EXPECT_GE(magnitudeOf(weight, weight.omega, 0.1).minCoeff(), weight.floor * (1 - 1e-9));
  EXPECT_GE(weight.margin, 1);
}

TEST(UncertaintyWeight, IsRefusedWherePlantsDoNotDiffer) {
  const Estimate estimate = test::estimateWithoutErrorModel(vectorOf({1.0}), vectorOf({0.5}), 0.0);
  EXPECT_THROW(weightOf(estimate), DataError);
}

}  // namespace
}  // namespace uncertainty_identification
