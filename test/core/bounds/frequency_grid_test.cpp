#include "bounds/frequency_grid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/core_setup.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using test::vectorOf;

TEST(FrequencyGrid, IsDenseAtResonances) {
  NominalModelEstimate plant;
  plant.sample_time = 0.01;
  plant.b = vectorOf({1.0});
  const double radius = 0.999, angle = 0.5;
  plant.a = vectorOf({-2 * radius * std::cos(angle), radius * radius});
  const VectorXd omega = frequencyGrid(plant, 500);
  ASSERT_EQ(omega.size(), 500);
  EXPECT_NEAR(omega[499], std::acos(-1.0) / 0.01, 1e-9);
  int within = 0;  // the half width of the peak
  for (Eigen::Index k = 0; k < 500; ++k) {
    if (k > 0) EXPECT_GT(omega[k], omega[k - 1]);
    within += std::abs(omega[k] * 0.01 - angle) < 0.001;
  }
  EXPECT_GE(within, 15);
  EXPECT_THROW(frequencyGrid(plant, 5), ConfigurationError);
}

}  // namespace
}  // namespace uncertainty_identification
