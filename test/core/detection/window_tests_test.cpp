// False-alarm rates of the tests on simulated noise, and the changes that each is sensitive to.
#include "detection/window_tests.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "math/random_stream.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

MatrixXd effectsOf(const VectorXd& signature) {
  MatrixXd effects = MatrixXd::Zero(signature.size(), 2);
  effects.col(0) = signature;
  effects.col(1).tail(signature.size() - 1) = signature.head(signature.size() - 1);
  return effects;
}

class WindowTestsOfSize : public testing::TestWithParam<int> {};

TEST_P(WindowTestsOfSize, AlarmAsOftenAsTheirProbabilitySays) {
  constexpr int kWindows = 20000;
  const int size = GetParam();
  auto random = randomStream(1, size, RandomPurpose::noise);
  Eigen::Array4d below = Eigen::Array4d::Zero();
  double combined_5 = 0, combined_1 = 0;
  for (int k = 0; k < kWindows; ++k) {
    const VectorXd z = gaussian(size, 1, random);
    const auto found = testWindow(z, effectsOf(gaussian(size, 1, random)), kInfinity);
    below += (found.tests.array() < 0.05).cast<double>();
    combined_5 += found.combined < 0.05 ? 1 : 0;
    combined_1 += found.combined < 0.01 ? 1 : 0;
  }
  // Binomial: standard deviations 0.0015 and 0.0007; four of them. The correlation test is about
  // chi-squared only, and the tests nearly independent: a tenth for both.
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(below[i] / kWindows, 0.05, 0.006) << i;
  EXPECT_NEAR(below[3] / kWindows, 0.05, 0.011);
  EXPECT_NEAR(combined_5 / kWindows, 0.05, 0.011);
  EXPECT_NEAR(combined_1 / kWindows, 0.01, 0.004);
}

INSTANTIATE_TEST_SUITE_P(Sizes, WindowTestsOfSize, testing::Values(20, 50, 200));

struct Disturbance {
  WindowTest expected;
  double scale, mean, input, correlation;
};

class WindowTestsOfFaults : public testing::TestWithParam<Disturbance> {};

TEST_P(WindowTestsOfFaults, TheTestForItIsTheStrongest) {
  const Disturbance& d = GetParam();
  constexpr int kSize = 200;
  auto random = randomStream(2, 0, RandomPurpose::noise);
  const VectorXd signature = gaussian(kSize, 4, random);
  VectorXd z = gaussian(kSize, 1, random);
  EXPECT_GT(testWindow(z, effectsOf(signature), kInfinity).combined, 0.01);
  for (int t = 1; t < kSize; ++t) z[t] += d.correlation * z[t - 1];
  z = d.scale * z + VectorXd::Constant(kSize, d.mean) + d.input * signature;
  const auto found = testWindow(z, effectsOf(signature), kInfinity);
  EXPECT_EQ(nameOf(found.strongest), std::string(nameOf(d.expected))) << found.tests.transpose();
  EXPECT_LT(found.combined, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Faults, WindowTestsOfFaults,
                         testing::Values(Disturbance{WindowTest::energy, 1.5, 0, 0, 0},
                                         Disturbance{WindowTest::mean, 1, 0.5, 0, 0},
                                         Disturbance{WindowTest::input, 1, 0, 0.2, 0},
                                         Disturbance{WindowTest::correlation, 0.9, 0, 0, 0.5}));

TEST(WindowTests, KnownValues) {
  // sum z^2 = 18.307 is the 95 % quantile of chi-squared(10).
  VectorXd z = VectorXd::Zero(10);
  z[3] = std::sqrt(18.307);
  const auto found = testWindow(z, MatrixXd::Zero(10, 2), kInfinity);
  EXPECT_NEAR(found.tests[0], 0.05, 1e-5);
  EXPECT_EQ(found.tests[2], 1.0) << "nothing excites: the test does not apply";
  // The mean's share is 1/10: Beta(1/2, 9/2), that is t^2 = 9 (1/10)/(9/10) = 1 at 9 degrees.
  EXPECT_NEAR(found.tests[1], 0.343436, 1e-5);
  // Three tests apply.
  EXPECT_NEAR(found.combined, 1 - std::pow(1 - found.tests.minCoeff(), 3), 1e-12);
}

TEST(WindowTests, AnUncertainNoiseVarianceWeighsOnTheEnergyOnly) {
  VectorXd z = VectorXd::Constant(20, 1.4);
  for (int t = 0; t < 20; t += 2) z[t] = -1.4;
  const auto sure = testWindow(z, MatrixXd::Zero(20, 2), kInfinity);
  const auto unsure = testWindow(z, MatrixXd::Zero(20, 2), 50);
  EXPECT_GT(unsure.tests[0], 1.5 * sure.tests[0]);
  EXPECT_EQ(unsure.tests[1], sure.tests[1]);
  EXPECT_EQ(unsure.tests[3], sure.tests[3]);
}

TEST(WindowTests, ExtremeScoresHaveAFiniteProbability) {
  const VectorXd z = VectorXd::Constant(50, 37);
  const auto found = testWindow(z, MatrixXd::Ones(50, 2), 1000);
  EXPECT_GT(found.combined, 0);
  EXPECT_LT(found.combined, 1e-50);
}

}  // namespace
}  // namespace uncertainty_identification
