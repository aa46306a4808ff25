// Whether a line in the residual's spectrum may come from the input.
#include "explanation/input_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace uncertainty_identification {
namespace {

template <typename Signal>
std::vector<Experiment> withInputs(const Signal& signal) {
  std::vector<Experiment> all(3);
  for (Experiment& experiment : all) {
    experiment.u.resize(600);
    for (int k = 0; k < 600; ++k) experiment.u[k] = signal(k);
  }
  return all;
}

TEST(InputLines, ASineHasOneAndItsHarmonics) {
  const auto sines = withInputs([](int k) { return 3 + std::sin(0.1 * k) + std::sin(0.37 * k); });
  for (const double frequency : {0.1, 0.37, 0.2, 0.3, 0.74})
    EXPECT_TRUE(mayComeFromInput(frequency, sines)) << frequency;
  for (const double frequency : {0.25, 0.9, 2.0})
    EXPECT_FALSE(mayComeFromInput(frequency, sines)) << frequency;
}

TEST(InputLines, ARandomInputAndStepsHaveNone) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  const auto noise = withInputs([&](int /*k*/) { return normal(random); });
  double level = 0;
  const auto steps = withInputs([&](int k) {
    if (k % 30 == 0) level = normal(random);
    return level;
  });
  const auto one = withInputs([](int k) { return k < 100 ? 0.0 : 1.0; });
  const auto constant = withInputs([](int /*k*/) { return 2.0; });
  for (double frequency = 0.05; frequency < 3; frequency += 0.05) {
    EXPECT_FALSE(mayComeFromInput(frequency, noise)) << frequency;
    EXPECT_FALSE(mayComeFromInput(frequency, steps)) << frequency;
    EXPECT_FALSE(mayComeFromInput(frequency, one)) << frequency;
    EXPECT_FALSE(mayComeFromInput(frequency, constant)) << frequency;
  }
}

}  // namespace
}  // namespace uncertainty_identification
