#include "estimation/least_squares_start.h"

#include <gtest/gtest.h>

#include <limits>

#include "math/polynomial.h"
#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

test::RandomSystemOptions secondOrder() {
  test::RandomSystemOptions options;
  options.nb = options.na = 2;
  options.nc = options.nd = options.taps = 0;
  options.delay = 3;
  options.min_samples = 200;
  options.max_samples = 300;
  options.experiments = 5;
  options.pole_radius = 0.9;
  options.noise_variance = 1e-20;
  options.input_run_up = 100;
  return options;
}

void expectTruth(const LeastSquaresModel& found, const dense::Model& truth, double tolerance) {
  ASSERT_EQ(found.polynomials.b.size(), truth.b.size());
  EXPECT_EQ(found.polynomials.delay, truth.delay);
  EXPECT_LT((found.polynomials.b - truth.b).norm(), tolerance * truth.b.norm());
  EXPECT_LT((found.polynomials.a - truth.a).norm(), tolerance * (1 + truth.a.norm()));
}

TEST(LeastSquaresStart, FindsNoiseFreeSystemsExactly) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto system = test::randomSystem(secondOrder(), seed);
    const LeastSquaresStart start(test::pointersTo(system.experiments), Constant::none);
    expectTruth(start.arx(2, 2, 3), system.truth, 1e-7);
  }
}

TEST(LeastSquaresStart, FindsTheOffsetOfTheOutput) {
  test::RandomSystemOptions options = secondOrder();
  options.output_offset = 4;
  const auto system = test::randomSystem(options, 2);
  const LeastSquaresModel found =
      LeastSquaresStart(test::pointersTo(system.experiments), Constant::common).arx(2, 2, 3);
  expectTruth(found, system.truth, 1e-7);
  EXPECT_NEAR(found.offset, 4, 1e-6);
}

/// Levels of the experiments' own, far larger than the answers to the input, are eliminated.
TEST(LeastSquaresStart, FindsNoiseFreeSystemsAtLevelsOfTheirOwn) {
  auto system = test::randomSystem(secondOrder(), 2);
  for (std::size_t r = 0; r < system.experiments.size(); ++r)
    system.experiments[r].y.array() += 100.0 * static_cast<double>(r * r);
  const auto found = [&](Constant constant) {
    return LeastSquaresStart(test::pointersTo(system.experiments), constant);
  };
  expectTruth(found(Constant::of_each).arx(2, 2, 3), system.truth, 1e-7);
  expectTruth(found(Constant::of_each).steiglitzMcBride(2, 2, 0, 5), system.truth, 1e-4);
  expectTruth(
      found(Constant::of_each).steiglitzMcBride(2, 2, 3, 3, LeastSquaresStart::Start::unknown),
      system.truth, 1e-4);
  const LeastSquaresModel at_common = found(Constant::common).arx(2, 2, 3);
  EXPECT_GT((at_common.polynomials.a - system.truth.a).norm(), 0.1);
}

/// The constant is filtered as the signals are.
TEST(LeastSquaresStart, SteiglitzMcBrideFindsTheOffsetToo) {
  test::RandomSystemOptions options = secondOrder();
  options.output_offset = 4;
  options.noise_variance = 0.01;
  options.experiments = 20;
  options.input_run_up = 0;  // the prefilter starts at rest
  auto system = test::randomSystem(options, 2);
  system.truth.a = test::vectorOf({-1.7, 0.75});
  system.truth.b = test::vectorOf({0.5, 0.3});
  system = test::simulateSystem(system.truth, options, 3);
  const LeastSquaresModel found =
      LeastSquaresStart(test::pointersTo(system.experiments), Constant::common)
          .steiglitzMcBride(2, 2, 3, 3);
  expectTruth(found, system.truth, 0.1);
  EXPECT_NEAR(found.offset, 4, 0.5);
}

/// White noise on the output biases ARX; the Steiglitz-McBride iteration removes the bias.
TEST(LeastSquaresStart, SteiglitzMcBrideHasLittleBiasInOutputNoise) {
  test::RandomSystemOptions options = secondOrder();
  options.noise_variance = 1;
  options.experiments = 40;
  auto system = test::randomSystem(options, 2);
  system.truth.a = test::vectorOf({-1.5, 0.7});
  system.truth.b = test::vectorOf({0.5, 0.3});
  system = test::simulateSystem(system.truth, options, 3);
  const LeastSquaresStart start(test::pointersTo(system.experiments), Constant::none);
  expectTruth(start.steiglitzMcBride(2, 2, 3, 3), system.truth, 0.02);
  EXPECT_GT((start.arx(2, 2, 3).polynomials.a - system.truth.a).norm(), 0.05);
}

TEST(LeastSquaresStart, FindsTheDelay) {
  test::RandomSystemOptions options = secondOrder();
  options.noise_variance = 0.1;
  for (int delay : {0, 1, 5}) {
    options.delay = delay;
    const auto system = test::randomSystem(options, 5);
    const LeastSquaresStart start(test::pointersTo(system.experiments), Constant::none);
    EXPECT_EQ(start.steiglitzMcBride(2, 2, 0, 8).polynomials.delay, delay);
  }
}

TEST(LeastSquaresStart, BridgesGaps) {
  test::RandomSystemOptions options = secondOrder();
  auto system = test::randomSystem(options, 5);
  for (Experiment& experiment : system.experiments) {
    experiment.valid.assign(static_cast<std::size_t>(experiment.samples()), 1);
    for (int k = 20; k < experiment.samples(); k += 40) {
      experiment.valid[static_cast<std::size_t>(k)] = 0;
      experiment.y[k] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  const LeastSquaresStart start(test::pointersTo(system.experiments), Constant::none);
  expectTruth(start.steiglitzMcBride(2, 2, 3, 3), system.truth, 0.3);
}

TEST(LeastSquaresStart, UsesPartOfTooMuchData) {
  test::RandomSystemOptions options = secondOrder();
  options.experiments = 60;
  const auto system = test::randomSystem(options, 5);
  const LeastSquaresStart start(test::pointersTo(system.experiments), Constant::none, 2000);
  expectTruth(start.arx(2, 2, 3), system.truth, 1e-7);
}

class HannanRissanen : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(HannanRissanen, FindsNoiseModelsOfLongResiduals) {
  const auto [nc, nd] = GetParam();
  const VectorXd c = test::vectorOf({0.5, -0.2}).head(nc), d = test::vectorOf({-1.2, 0.5}).head(nd);
  test::RandomSystemOptions options;
  options.na = options.taps = 0;
  options.nc = nc;
  options.nd = nd;
  dense::Model truth;
  truth.b = VectorXd::Zero(1);
  truth.c = c;
  truth.d = nd == 1 ? test::vectorOf({-0.8}) : d;
  truth.T.resize(0, 0);
  options.experiments = 20;
  options.min_samples = options.max_samples = 1000;
  std::vector<VectorXd> residuals;
  for (const Experiment& experiment : test::simulateSystem(truth, options, 1).experiments) {
    residuals.push_back(experiment.y);
  }
  VectorXd found_c, found_d;
  hannanRissanen(residuals, nc, nd, &found_c, &found_d);
  ASSERT_EQ(found_c.size(), nc);
  ASSERT_EQ(found_d.size(), nd);
  EXPECT_LT((found_c - truth.c).norm(), 0.1) << found_c.transpose();
  EXPECT_LT((found_d - truth.d).norm(), 0.1) << found_d.transpose();
}

INSTANTIATE_TEST_SUITE_P(Orders, HannanRissanen,
                         testing::Values(std::pair{1, 1}, std::pair{0, 2}, std::pair{2, 0},
                                         std::pair{2, 2}, std::pair{0, 0}));

TEST(HannanRissanenModels, AreStableAndMinimumPhase) {
  std::vector<VectorXd> residuals;
  for (int k = 0; k < 3; ++k) residuals.push_back(VectorXd::LinSpaced(60, 0, 1));  // a drift
  VectorXd c, d;
  hannanRissanen(residuals, 2, 2, &c, &d);
  EXPECT_TRUE(isStable(c));
  EXPECT_TRUE(isStable(d));
}

}  // namespace
}  // namespace uncertainty_identification
