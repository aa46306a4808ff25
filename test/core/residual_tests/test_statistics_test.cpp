// The statistics of residual tests against values computed by hand.
#include "residual_tests/test_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kUndefined = 0.25;

/// Two experiments of unequal length whose output is white noise of variance 1.
std::vector<Experiment> whiteNoise() {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  std::vector<Experiment> experiments(2);
  for (const int k : {0, 1}) {
    Experiment& experiment = experiments[static_cast<std::size_t>(k)];
    experiment.sample_time = 1;
    experiment.u = VectorXd::Zero(1000 + 500 * k);
    experiment.y = VectorXd::NullaryExpr(experiment.u.size(), [&] { return normal(engine); });
  }
  return experiments;
}

std::vector<Signals> outputs(const std::vector<Block>& blocks) {
  std::vector<Signals> all;
  for (const Block& block : blocks) all.push_back(block.y);
  return all;
}

TEST(TestStatistics, ChiSquaredTailIsTheExponentialOfHalfTheSumAtTwoDegrees) {
  EXPECT_NEAR(chiSquaredTail(3, 2, kUndefined), std::exp(-1.5), 1e-12);
  EXPECT_NEAR(chiSquaredTail(-1, 2, kUndefined), 1, 1e-12);
}

TEST(TestStatistics, ChiSquaredTailIsUndefinedWithoutASumOrDegrees) {
  EXPECT_EQ(chiSquaredTail(std::nan(""), 2, kUndefined), kUndefined);
  EXPECT_EQ(chiSquaredTail(std::numeric_limits<double>::infinity(), 2, kUndefined), kUndefined);
  EXPECT_EQ(chiSquaredTail(3, 0, kUndefined), kUndefined);
}

TEST(TestStatistics, NormalTailCountsBothSides) {
  EXPECT_NEAR(twoSidedNormalTail(1.959964), 0.05, 1e-6);
  EXPECT_NEAR(twoSidedNormalTail(-1.959964), 0.05, 1e-6);
  EXPECT_EQ(twoSidedNormalTail(std::nan("")), 1);
}

TEST(TestStatistics, QuadraticFormLeavesOutWhatTheMatrixHardlyDetermines) {
  const MatrixXd A = test::vectorOf({4, 1e-3}).asDiagonal();
  const VectorXd x = test::vectorOf({2, 1});
  const QuadraticForm all = quadraticForm(A, x, 1e-6), determined = quadraticForm(A, x, 1e-2);
  EXPECT_NEAR(all.value, 1 + 1000, 1e-9);
  EXPECT_EQ(all.rank, 2);
  EXPECT_NEAR(determined.value, 1, 1e-12);
  EXPECT_EQ(determined.rank, 1);
}

TEST(TestStatistics, CorrelationsAreSumsOfProductsOverTheRootOfTheSamples) {
  const std::vector<Experiment> experiments = whiteNoise();
  const VectorXd correlations = scaledCorrelations(outputs(makeBlocks(experiments)), 3, 2500);
  ASSERT_EQ(correlations.size(), 3);
  for (int lag = 1; lag <= 3; ++lag) {
    double sum = 0;
    for (const Experiment& experiment : experiments) {
      const VectorXd& y = experiment.y;
      sum += y.tail(y.size() - lag).dot(y.head(y.size() - lag));
    }
    EXPECT_NEAR(correlations[lag - 1], sum / 50, 1e-9);
    EXPECT_LT(std::abs(correlations[lag - 1]), 4) << "white noise: standard deviation 1";
  }
}

TEST(TestStatistics, TimeBinsArePartsOfEachExperimentsDuration) {
  const std::vector<Experiment> experiments = whiteNoise();
  const std::vector<Block> blocks = makeBlocks(experiments);
  const VectorXd bins = scaledTimeBins(outputs(blocks), blocks, 5);
  ASSERT_EQ(bins.size(), 5);
  const double sum = experiments[0].y.segment(400, 200).sum() +  //
                     experiments[1].y.segment(600, 300).sum();
  EXPECT_NEAR(bins[2], sum / std::sqrt(500.0), 1e-9);
}

}  // namespace
}  // namespace uncertainty_identification
