#include "bounds/structure_bound.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/constants.h"
#include "support/core_setup.h"
#include "support/plain_estimate.h"
#include "uncertainty_identification/bounds/complex_region.h"
#include "uncertainty_identification/bounds/uncertainty_weight.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using test::vectorOf;

constexpr double kLevel = 0.95;
const double kQuantile = std::sqrt(-std::log(0.05));

Estimate precise(const StructureError& error) {
  Estimate estimate = test::estimateWithoutErrorModel(vectorOf({0.5}), vectorOf({-0.8}), 1e-12);
  estimate.structure_error = error;
  return estimate;
}

const Band& at95(const std::vector<Band>& bands) { return bands.at(2); }

TEST(StructureBound, IsTheRadiusOfAComplexGaussian) {
  const StructureError error{vectorOf({1, 100}), vectorOf({0.01, 1})};
  const VectorXd bound =
      structureBound(error, vectorOf({0.1, 1, 10, 100, 300}), kLevel) / kQuantile;
  const VectorXd expected = vectorOf({0.01, 0.01, 0.1, 1, 1});  // a straight line on log-log axes
  for (Eigen::Index k = 0; k < bound.size(); ++k) EXPECT_NEAR(bound[k], expected[k], 1e-12) << k;
  EXPECT_EQ(structureBound({vectorOf({1}), vectorOf({1e9})}, vectorOf({2}), kLevel)[0], 10);
  EXPECT_EQ(structureBound({}, vectorOf({1, 2}), kLevel), VectorXd::Zero(2));
}

// The plant is known to 1e-6, so that the bands are the structure's error.
TEST(StructureBound, WidensTheBandsWithEstimationErrors) {
  const Estimate estimate = precise({vectorOf({1, 10, 20}), vectorOf({0.01, 0.2, 5})});
  const VectorXd omega = vectorOf({1, 10, 20});
  const FrequencyBounds bounds = frequencyBounds(PlantDistribution(estimate), omega, {}, 1);
  const Band &magnitude = at95(bounds.magnitude_bands.total.pointwise),
             &phase = at95(bounds.phase_bands.total.pointwise),
             &error = at95(bounds.relative_error.total.simultaneous);
  for (const int k : {0, 1}) {
    const double by = kQuantile * estimate.structure_error.relative[k];
    EXPECT_NEAR(magnitude.upper[k] / bounds.magnitude[k], 1 + by, 1e-4);
    EXPECT_NEAR(magnitude.lower[k] / bounds.magnitude[k], 1 - by, 1e-4);
    EXPECT_NEAR(phase.upper[k] - bounds.phase[k], std::asin(by), 1e-4);
    EXPECT_NEAR(error.upper[k], by, 1e-4);
  }
  EXPECT_EQ(bounds.hidden_from, 20);
  EXPECT_EQ(magnitude.lower[2], 0);
  EXPECT_NEAR(phase.upper[2] - phase.lower[2], 2 * kPi, 1e-9);
  EXPECT_LT(at95(bounds.magnitude_bands.mixture.pointwise).upper[1], bounds.magnitude[1] * 1.001)
      << "the mixture alone is as estimated";
}

TEST(StructureBound, HidesThePlantOnlyWhereNothingAboveIsKnown) {
  const auto hiddenFrom = [](double first, double last) {
    const Estimate estimate = precise({vectorOf({1, 2, 20}), vectorOf({0.01, first, last})});
    return frequencyBounds(PlantDistribution(estimate), vectorOf({1, 2, 20}), {}, 1).hidden_from;
  };
  EXPECT_EQ(hiddenFrom(5, 5), 2);
  EXPECT_FALSE(hiddenFrom(5, 0.1)) << "a notch of the input";
}

TEST(StructureBound, IsAddedToOtherErrorsAsIndependent) {
  double lower = 3, upper = 7;
  widen(4, 4, &lower, &upper);
  EXPECT_DOUBLE_EQ(upper, 4 + 5);
  EXPECT_DOUBLE_EQ(lower, 4 - std::sqrt(17.0));
  lower = 3, upper = 7;
  widen(20, 0, &lower, &upper);
  EXPECT_EQ(lower, 3);
  EXPECT_EQ(upper, 7);
}

TEST(StructureBound, WidensRegionsAndWeight) {
  const Estimate estimate = precise({vectorOf({1, 10}), vectorOf({0.1, 0.1})});
  const PlantDistribution plants(estimate);
  const VectorXd omega = VectorXd::LinSpaced(50, 0.5, 20);
  BoundsOptions options;
  options.levels = {kLevel};
  const ComplexRegion region = complexRegions(plants, vectorOf({5}), options, 1).at(0);
  const ComplexResponses go = frequencyResponses(plants.nominal(), vectorOf({5}));
  const double gain = std::hypot(go.real(0, 0), go.imaginary(0, 0));
  const auto shape = region.real.array() + std::complex<double>(0, 1) * region.imaginary.array();
  const double angle = -5 * plants.nominal().sample_time * plants.nominal().delay;
  const std::complex<double> center =
      std::complex<double>(go.real(0, 0), go.imaginary(0, 0)) * std::polar(1.0, angle);
  const Eigen::ArrayXd distance = (shape - center).abs() / gain;
  EXPECT_GE(distance.minCoeff(), 0.99 * kQuantile * 0.1);
  EXPECT_LE(distance.maxCoeff(), 1.2 * kQuantile * 0.1) << "a polygon with 24 sides about a circle";
  options.weight_level = kLevel;
  const UncertaintyWeight weight = uncertaintyWeight(plants, omega, options, 1);
  EXPECT_NEAR(magnitudeOf(weight, vectorOf({5}), plants.nominal().sample_time)[0], kQuantile * 0.1,
              0.02);
}

}  // namespace
}  // namespace uncertainty_identification
