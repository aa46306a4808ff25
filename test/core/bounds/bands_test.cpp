#include "uncertainty_identification/bounds/bands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::ArrayXf;
using Eigen::ArrayXXf;

/// draws x points: a random walk over the points, heavy-tailed.
ArrayXXf walks(int draws, int points) {
  std::mt19937_64 random(7);
  std::student_t_distribution<float> step(2);
  ArrayXXf all(draws, points);
  for (int i = 0; i < draws; ++i) {
    float at = 0;
    for (int k = 0; k < points; ++k) all(i, k) = at += step(random);
  }
  return all;
}

Bands bandsOf(const ArrayXXf& values, const std::vector<double>& levels, Sides sides) {
  BandBuilder builder(levels, static_cast<int>(values.rows()), values.cols(), sides, 1e-6F);
  for (Eigen::Index k = 0; k < values.cols(); ++k) builder.add(values.col(k));
  return builder.bands();
}

TEST(Bands, PointwiseLimitsAreOrderStatistics) {
  const ArrayXXf values = walks(999, 23);
  const Bands bands = bandsOf(values, {0.5, 0.9, 0.99}, Sides::two);
  const int lower[] = {249, 49, 4};  // of ranks from 0: k of 1000 gaps lie below the k-th draw
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    std::vector<float> sorted(values.col(k).data(), values.col(k).data() + 999);
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t level = 0; level < 3; ++level) {
      const auto rank = static_cast<std::size_t>(lower[level]);
      EXPECT_EQ(bands.pointwise[level].lower[k], sorted[rank]) << level;
      EXPECT_EQ(bands.pointwise[level].upper[k], sorted[998 - rank]) << level;
    }
  }
}

TEST(Bands, UpperLimitsAreOrderStatistics) {
  const ArrayXXf values = walks(999, 5).abs();
  const Bands bands = bandsOf(values, {0.9}, Sides::upper);
  std::vector<float> sorted(values.col(4).data(), values.col(4).data() + 999);
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(bands.pointwise[0].upper[4], sorted[899]);
  EXPECT_EQ(bands.pointwise[0].lower[4], 0);
}

/// The share of draws that stay inside the band everywhere is at least the level and not much
/// larger.
TEST(Bands, SimultaneousBandsHoldTheirShare) {
  const ArrayXXf values = walks(999, 30);
  for (Sides sides : {Sides::two, Sides::upper}) {
    const ArrayXXf used = sides == Sides::two ? values : values.abs();
    const Bands bands = bandsOf(used, {0.5, 0.95}, sides);
    for (const Band& band : bands.simultaneous) {
      int inside = 0, pointwise = 0;
      for (Eigen::Index i = 0; i < used.rows(); ++i) {
        const Eigen::ArrayXd row = used.row(i).transpose().cast<double>();
        inside += (row <= band.upper.array() + 1e-4 && row >= band.lower.array() - 1e-4).all();
        pointwise += (row <= band.upper.array() && row >= band.lower.array()).all();
      }
      EXPECT_GE(inside, band.level * 999);
      EXPECT_LE(pointwise, band.level * 1000 + 1);
    }
  }
}

TEST(Bands, HigherLevelsHoldLowerOnes) {
  const Bands bands = bandsOf(walks(999, 30), {0.3, 0.5, 0.95, 0.99}, Sides::two);
  for (std::size_t k = 0; k < 4; ++k) {
    const Band &band = bands.simultaneous[k], &pointwise = bands.pointwise[k];
    EXPECT_TRUE((band.upper.array() >= pointwise.upper.array()).all());
    EXPECT_TRUE((band.lower.array() <= pointwise.lower.array()).all());
    if (k == 0) continue;
    EXPECT_TRUE((band.upper.array() >= bands.simultaneous[k - 1].upper.array()).all());
    EXPECT_TRUE((band.lower.array() <= bands.simultaneous[k - 1].lower.array()).all());
  }
}

TEST(Bands, RoundingDoesNotStretchThem) {
  ArrayXXf values = walks(999, 10);
  std::mt19937_64 random(1);
  for (int i = 0; i < 999; ++i)
    values(i, 3) = std::uniform_real_distribution<float>(0, 1e-8F)(random);
  values(17, 3) = 5e-7F;  // far outside the others, and yet nothing
  const Bands bands = bandsOf(values, {0.9}, Sides::two);
  values.col(3).setZero();
  const Bands without = bandsOf(values, {0.9}, Sides::two);
  EXPECT_NEAR(bands.simultaneous[0].upper[9], without.simultaneous[0].upper[9], 1e-5);
  EXPECT_LT(bands.simultaneous[0].upper[3], 1e-4);
}

/// Errors of an estimate can be so large that responses overflow. Such draws must count as very
/// large.
TEST(Bands, TakeWhatIsNotFinite) {
  ArrayXXf values = walks(999, 3);
  const float infinite = std::numeric_limits<float>::infinity();
  values.block(0, 1, 100, 1).setConstant(infinite);
  values.block(100, 1, 100, 1).setConstant(std::numeric_limits<float>::quiet_NaN());
  values.block(200, 1, 100, 1).setConstant(-infinite);
  values.col(2).setConstant(infinite);
  const Bands bands = bandsOf(values, {0.3, 0.95}, Sides::two);
  EXPECT_LT(std::abs(bands.pointwise[0].upper[1]), 1e6);
  EXPECT_GT(bands.pointwise[1].upper[1], 1e20);
  EXPECT_LT(bands.pointwise[1].lower[1], -1e20);
  EXPECT_GT(bands.pointwise[0].upper[2], 1e20);
  for (const Band& band : bands.simultaneous) EXPECT_TRUE(band.upper.allFinite());
}

/// Normal values: the standard deviation of the 95 % limit is sqrt(q(1-q)/S)/density.
TEST(Bands, ReportTheErrorOfDrawing) {
  std::mt19937_64 random(5);
  std::normal_distribution<float> normal;
  const ArrayXXf values = ArrayXXf::NullaryExpr(4000, 400, [&] { return normal(random); });
  const Bands bands = bandsOf(values, {0.95}, Sides::two);
  const double expected = std::sqrt(0.025 * 0.975 / 4000) / 0.05845 / (2 * 1.96);
  EXPECT_NEAR(bands.monte_carlo_error[0], expected, 0.15 * expected);
}

TEST(Bands, RefuseLevelsThatTheDrawsCannotShow) {
  EXPECT_THROW(BandBuilder({0.99}, 100, 5, Sides::two, 0), ConfigurationError);
  EXPECT_THROW(BandBuilder({1.0}, 100, 5, Sides::two, 0), ConfigurationError);
  EXPECT_THROW(BandBuilder({0.0}, 100, 5, Sides::two, 0), ConfigurationError);
  EXPECT_NO_THROW(BandBuilder({0.99}, 100, 5, Sides::upper, 0));
}

}  // namespace
}  // namespace uncertainty_identification
