#include "curves/unpredictable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace uncertainty_identification {
namespace {

/// Residuals in windows, each of which keeps this share of the one before and adds white noise.
WindowFit residuals(double kept, int windows, int samples) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  WindowFit fit;
  for (int w = 0; w < windows; ++w) {
    Eigen::VectorXd residual(samples);
    double value = 0;
    for (int t = 0; t < samples; ++t) residual[t] = value = kept * value + normal(random);
    fit.residuals.push_back(residual);
  }
  return fit;
}

// An autoregression of first order has a variance of 1 / (1 - kept^2). Tolerances are four standard
// errors of a variance's estimate from 4,000 samples, less what ten parameters take up.
TEST(UnpredictableShare, IsOneOfWhiteNoiseAndLittleOfWhatIsSlow) {
  EXPECT_NEAR(unpredictableShare(residuals(0, 8, 500)), 1, 0.02);
  EXPECT_NEAR(unpredictableShare(residuals(0.9, 8, 500)), 0.19, 0.04);
}

TEST(UnpredictableShare, IsNotMeasuredInFewSamplesOrWhereNothingIsLeft) {
  EXPECT_TRUE(std::isnan(unpredictableShare(residuals(0, 2, 50))));
  EXPECT_TRUE(std::isnan(unpredictableShare({})));
  WindowFit nothing = residuals(0, 8, 500);
  for (Eigen::VectorXd& residual : nothing.residuals) residual.setZero();
  EXPECT_TRUE(std::isnan(unpredictableShare(nothing)));
}

}  // namespace
}  // namespace uncertainty_identification
