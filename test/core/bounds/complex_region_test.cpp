#include "uncertainty_identification/bounds/complex_region.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "support/core_setup.h"
#include "support/plain_estimate.h"

namespace uncertainty_identification {
namespace {

/// A point is inside a polygon with counterclockwise corners if it lies to the left of all sides.
bool holds(const ComplexRegion& region, double re, double im) {
  const Eigen::Index corners = region.real.size();
  for (Eigen::Index k = 0; k < corners; ++k) {
    const Eigen::Index next = (k + 1) % corners;
    const double side_re = region.real[next] - region.real[k];
    const double side_im = region.imaginary[next] - region.imaginary[k];
    if (side_re * (im - region.imaginary[k]) - side_im * (re - region.real[k]) < 0) return false;
  }
  return corners >= 3;
}

TEST(ComplexRegions, HoldTheirShareOfOtherPlants) {
  const Estimate estimate =
      test::plainEstimate(test::vectorOf({1.0, 0.2}), test::vectorOf({-0.6}), 1e-4);
  const PlantDistribution plants(estimate);
  const Eigen::VectorXd omega = test::vectorOf({0.1, 3.0, 25.0});
  const BoundsOptions options;
  const std::vector<ComplexRegion> regions = complexRegions(plants, omega, options, 1);
  ASSERT_EQ(regions.size(), 12u);
  const int count = 4000;
  const PlantSamples fresh = plants.draw(count, Uncertainty::total, 5);
  const ComplexResponses all = frequencyResponses(fresh, omega);
  for (std::size_t k = 0; k < regions.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k / 4);
    EXPECT_EQ(regions[k].omega, omega[column]);
    EXPECT_EQ(regions[k].level, options.levels[k % 4]);
    const std::complex<double> delay = std::polar(1.0, -omega[column] * 0.1);
    int inside = 0;
    for (int i = 0; i < count; ++i) {
      const std::complex<double> z =
          delay * std::complex<double>(all.real(i, column), all.imaginary(i, column));
      inside += holds(regions[k], z.real(), z.imag());
    }
    const double level = regions[k].level;
    EXPECT_NEAR(inside / 4000.0, level,
                4 * std::sqrt(level * (1 - level) * (1.0 / 4000 + 1.0 / 2000)))
        << k;
  }
}

/// Responses on a line have a thin region.
TEST(ComplexRegions, OfResponsesOnALine) {
  Estimate estimate = test::plainEstimate(test::vectorOf({1.0}), test::vectorOf({0.5}));
  estimate.joint_covariance.resize(0, 0);
  const std::vector<ComplexRegion> regions =
      complexRegions(PlantDistribution(estimate), test::vectorOf({3.0}), BoundsOptions(), 1);
  ASSERT_EQ(regions.size(), 4u);
  EXPECT_GE(regions[2].real.size(), 3);
  EXPECT_TRUE(regions[2].real.allFinite());
}

}  // namespace
}  // namespace uncertainty_identification
