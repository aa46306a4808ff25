#include "uncertainty_identification/bounds/bounds.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/core_setup.h"
#include "support/plain_estimate.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using test::vectorOf;

TEST(ComputeBounds, FollowTheConfiguration) {
  Estimate estimate = test::plainEstimate(vectorOf({1.0}), vectorOf({-0.5}), 1e-5);
  BoundsOptions& options = estimate.configuration.bounds;
  options.levels = {0.6, 0.8};
  options.grid = vectorOf({1.0, 2.0, 5.0});
  options.steps = 7;
  options.samples = 500;
  options.weight_order = 2;
  options.weight_level = 0.7;
  const Bounds bounds = computeBounds(estimate);
  EXPECT_EQ(bounds.frequency.omega, options.grid);
  EXPECT_EQ(bounds.frequency.magnitude_bands.total.simultaneous.size(), 2u);
  EXPECT_EQ(bounds.step.time.size(), 7);
  EXPECT_EQ(bounds.regions.size(), 6u);
  EXPECT_EQ(bounds.weight->order, 2);
  EXPECT_EQ(bounds.weight->level, 0.7);
  EXPECT_TRUE(bounds.warnings.empty());
}

TEST(ComputeBounds, SayWhatTheyCannotCount) {
  Estimate estimate = test::plainEstimate(vectorOf({1.0}), vectorOf({-0.5}));
  estimate.joint_covariance.resize(0, 0);
  const Bounds bounds = computeBounds(estimate);
  ASSERT_EQ(bounds.warnings.size(), 1u);
  EXPECT_NE(bounds.warnings[0].find("too narrow"), std::string::npos);

  const Bounds certain =
      computeBounds(test::estimateWithoutErrorModel(vectorOf({1.0}), vectorOf({-0.5}), 0.0));
  EXPECT_FALSE(certain.weight.has_value());
  ASSERT_EQ(certain.warnings.size(), 1u);
  EXPECT_NE(certain.warnings[0].find("no robust-control weight"), std::string::npos);
}

/// The uncertainty of a pole near 1 is so large that nearly all draws have a smaller static gain
/// 1/(1 - p) than the estimate.
TEST(ComputeBounds, SayWhenErrorsAreTooLargeForThem) {
  Estimate estimate = test::estimateWithoutErrorModel(vectorOf({0.1}), vectorOf({-0.9}), 1e-6);
  EXPECT_TRUE(computeBounds(estimate).warnings.empty());
  estimate.nominal_model.b = vectorOf({1.0, -0.9});
  estimate.nominal_model.a = vectorOf({-1.8, 0.82});
  estimate.joint_covariance = 0.3 * Eigen::MatrixXd::Identity(4, 4);
  const std::vector<std::string> warnings = computeBounds(estimate).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("inaccurate"), std::string::npos) << warnings[0];
}

TEST(ComputeBounds, AreTheSameEveryTime) {
  const Estimate estimate = test::plainEstimate(vectorOf({1.0}), vectorOf({-0.5}), 1e-5);
  const Bounds first = computeBounds(estimate), second = computeBounds(estimate);
  EXPECT_EQ(first.frequency.phase_bands.total.simultaneous[3].upper,
            second.frequency.phase_bands.total.simultaneous[3].upper);
  EXPECT_EQ(first.weight->num, second.weight->num);
}

}  // namespace
}  // namespace uncertainty_identification
