#include "simulation/input.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "math/random_stream.h"

namespace uncertainty_identification {
namespace {

constexpr int kSamples = 40000;

Eigen::VectorXd input(InputKind kind, int hold, std::uint64_t seed = 1) {
  InputTruth truth;
  truth.kind = kind;
  truth.mean = 3;
  truth.variance = 4;
  truth.hold = hold;
  auto random = randomStream(seed, 0, RandomPurpose::input);
  return makeInput(truth, kSamples, random);
}

double variance(const Eigen::VectorXd& signal) {
  return (signal.array() - signal.mean()).square().mean();
}

class EveryInput : public testing::TestWithParam<InputKind> {};

TEST_P(EveryInput, HasTheMeanAndTheVarianceAskedFor) {
  const Eigen::VectorXd u = input(GetParam(), 1);
  // Four standard errors of 40,000 independent samples: 0.04 of the mean, 0.11 of a normal
  // variance.
  EXPECT_NEAR(u.mean(), 3, 0.04);
  EXPECT_NEAR(variance(u), 4, 0.12);
}

TEST_P(EveryInput, DependsOnTheSeed) {
  EXPECT_EQ(input(GetParam(), 1, 1), input(GetParam(), 1, 1));
  EXPECT_NE(input(GetParam(), 1, 1), input(GetParam(), 1, 2));
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryInput,
                         testing::Values(InputKind::white_noise, InputKind::prbs, InputKind::steps,
                                         InputKind::multisine));

TEST(Input, HoldsItsValues) {
  for (const InputKind kind : {InputKind::white_noise, InputKind::prbs, InputKind::steps}) {
    const Eigen::VectorXd u = input(kind, 7);
    std::set<double> held;
    for (int k = 0; k < 700; ++k) {
      EXPECT_EQ(u(k), u(k - k % 7));
      held.insert(u(k));
    }
    EXPECT_GT(held.size(), kind == InputKind::prbs ? 1u : 90u);
  }
}

TEST(Input, PrbsHasTwoLevels) {
  const Eigen::VectorXd u = input(InputKind::prbs, 1);
  EXPECT_EQ(std::set<double>(u.data(), u.data() + u.size()), (std::set<double>{1, 5}));
}

TEST(Input, StepsAreUniform) {
  const Eigen::VectorXd u = input(InputKind::steps, 1);
  const double half = 2 * std::sqrt(3.0);
  EXPECT_LE((u.array() - 3).abs().maxCoeff(), half);
  EXPECT_GE((u.array() - 3).abs().maxCoeff(), 0.99 * half);
}

TEST(Input, MultisineHasItsTonesOnly) {
  const Eigen::VectorXd u = input(InputKind::multisine, 1);
  EXPECT_NEAR(variance(u), 4, 1e-9);  // over whole periods it is exact
  const double step = 2 * std::acos(-1.0) / kSamples;
  for (const int harmonic : {1, 10, 11, 200}) {
    double cosine = 0, sine = 0;
    for (int k = 0; k < kSamples; ++k) {
      cosine += u(k) * std::cos(harmonic * step * k);
      sine += u(k) * std::sin(harmonic * step * k);
    }
    const double power = 2 * (cosine * cosine + sine * sine) / (double(kSamples) * kSamples);
    EXPECT_NEAR(power, harmonic <= 10 ? 0.4 : 0, 1e-9) << harmonic;
  }
}

TEST(RandomStream, DiffersByPurposeExperimentAndTheWholeSeed) {
  std::set<std::uint64_t> first;
  for (const std::uint64_t seed :
       {std::uint64_t{1}, std::uint64_t{2}, (std::uint64_t{1} << 32) + 1}) {
    for (const int r : {0, 1}) {
      for (const RandomPurpose purpose : {RandomPurpose::input, RandomPurpose::noise}) {
        first.insert(randomStream(seed, r, purpose)());
      }
    }
  }
  EXPECT_EQ(first.size(), 12u);
}

}  // namespace
}  // namespace uncertainty_identification
