#include "data/bandwidth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace uncertainty_identification {
namespace {

Eigen::VectorXd sine(int samples, double frequency, double ramp = 0) {
  Eigen::VectorXd signal(samples);
  for (int k = 0; k < samples; ++k) signal[k] = std::sin(2 * M_PI * frequency * k) + ramp * k;
  return signal;
}

TEST(Bandwidth, OfSinesIsTheHighestFrequencyOfWeight) {
  EXPECT_NEAR(bandwidth(sine(4096, 0.05)), 0.05, 0.001);
  EXPECT_NEAR(bandwidth(sine(3000, 0.05) + 0.5 * sine(3000, 0.2)), 0.2, 0.001);
  EXPECT_NEAR(bandwidth(sine(3000, 0.05) + 0.01 * sine(3000, 0.2)), 0.05, 0.001)
      << "a ten-thousandth of the power";
}

TEST(Bandwidth, IgnoresTheLineThroughTheEndsAndTheNoiseFloor) {
  EXPECT_NEAR(bandwidth(sine(4000, 0.05, 10)), 0.05, 0.002);
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  Eigen::VectorXd noisy = sine(20000, 0.01);
  for (int k = 0; k < noisy.size(); ++k) noisy[k] += 0.02 * normal(random);
  EXPECT_LT(bandwidth(noisy), 0.02);
}

TEST(Bandwidth, OfNothingIsTheHighestFrequency) {
  EXPECT_DOUBLE_EQ(bandwidth(Eigen::VectorXd::Constant(100, 3)), 0.5);
  EXPECT_DOUBLE_EQ(bandwidth(Eigen::VectorXd::LinSpaced(128, 0, 1)), 0.5);
}

}  // namespace
}  // namespace uncertainty_identification
