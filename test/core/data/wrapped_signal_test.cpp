// Outputs that jump as an angle does at 360 degrees, and others that jump.
#include "data/wrapped_signal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace uncertainty_identification {
namespace {

template <typename Output>
Experiment with(Output output) {
  Experiment experiment;
  experiment.u = Eigen::VectorXd::Zero(400);
  experiment.y.resize(400);
  for (int k = 0; k < 400; ++k) experiment.y[k] = output(k);
  return experiment;
}

TEST(WrapsOf, AnAngleThatStartsAgain) {
  const auto angle = [](double per_sample) {
    return with([=](int k) {
      const double turns = per_sample * k / 360;
      return 360 * (turns - std::floor(turns));
    });
  };
  EXPECT_EQ(wrapsOf(angle(5)), 5);
  EXPECT_EQ(wrapsOf(angle(-84)), 92) << "fast; before the first of 93 jumps nothing moved";
  EXPECT_EQ(wrapsOf(angle(1)), 0) << "once only";
}

TEST(WrapsOf, MissingSamplesDoNotMatter) {
  Experiment angle = with([](int k) { return std::fmod(5.0 * k, 360.0); });
  angle.valid.assign(400, 1);
  for (std::size_t k = 0; k < 400; k += 7) angle.valid[k] = 0;
  EXPECT_EQ(wrapsOf(angle), 5);
}

TEST(WrapsOf, OtherOutputsDoNotWrap) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  for (int seed = 0; seed < 50; ++seed) {
    EXPECT_EQ(wrapsOf(with([&](int) { return normal(engine); })), 0) << "noise";
    EXPECT_EQ(wrapsOf(with([&](int k) { return (k / 20) % 2 + 0.02 * normal(engine); })), 0)
        << "two levels";
    EXPECT_EQ(wrapsOf(with([&](int k) { return std::sin(0.3 * k) + 0.05 * normal(engine); })), 0)
        << "a wave";
    EXPECT_EQ(wrapsOf(with([&](int k) { return 0.02 * normal(engine) + (k % 40 == 0); })), 0)
        << "spikes";
  }
}

TEST(WrapsOf, NothingInAnEmptyOrConstantOutput) {
  EXPECT_EQ(wrapsOf(Experiment()), 0);
  EXPECT_EQ(wrapsOf(with([](int) { return 3; })), 0);
}

}  // namespace
}  // namespace uncertainty_identification
