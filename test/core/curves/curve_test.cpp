#include "curves/curve.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <array>
#include <cmath>

namespace uncertainty_identification {
namespace {

Eigen::VectorXd spreadSamples() {
  Eigen::VectorXd samples(997);
  for (Eigen::Index k = 0; k < samples.size(); ++k)
    samples[k] = 2 * std::sin(static_cast<double>(k)) + 0.01 * static_cast<double>(k % 37);
  return samples;
}

Eigen::VectorXd someParameters(const Curve& curve) {
  Eigen::VectorXd parameters = Eigen::VectorXd::Constant(curve.parameters(), 0.4);
  if (curve.shape())
    for (std::size_t k = 0; k < curve.shape()->parameters.size(); ++k)
      parameters[(curve.shape()->is_whole ? 0 : 1) + static_cast<Eigen::Index>(k)] =
          curve.shape()->starts.front()[k];
  return parameters;
}

/// What the linear plant has, a constant and a slope, must not be in the curve as well.
TEST(Curve, HasNoLinearPart) {
  const Curve place(Place::input, nullptr, spreadSamples(), 0);
  std::vector<Curve> curves{place};
  for (const Shape* shape : shapesAt(Place::input)) curves.push_back(place.shaped(shape));
  for (const Curve& curve : curves) {
    const Eigen::VectorXd value = curve.atSamples(someParameters(curve)), z = curve.samples();
    const double size = value.norm() * z.norm() + 1e-9;
    const std::string name = curve.shape() ? curve.shape()->name : "free";
    EXPECT_LT(std::abs(value.dot(z)), 1e-6 * size) << name;
    EXPECT_LT(std::abs(value.sum()), 1e-6 * size) << name;
  }
}

/// Steps of three heights from rest: there are as many free values as levels, less the linear part.
TEST(Curve, BendsAtEachLevelOfAnInputThatHasFew) {
  Eigen::VectorXd samples(400);
  for (Eigen::Index k = 0; k < 400; ++k)
    samples[k] = std::array<double, 4>{0, 6, 12, 24}[k * 4 / 400];
  const Curve curve(Place::input, nullptr, samples, 0);
  ASSERT_EQ(curve.parameters(), 2);
  Eigen::MatrixXd free(400, 4);
  free << curve.atSamples(Eigen::Vector2d(1, 0)), curve.atSamples(Eigen::Vector2d(0, 1)),
      curve.samples(), Eigen::VectorXd::Ones(400);
  const Eigen::VectorXd dead_zone = (curve.samples().array() - 2.3).max(0.0);
  const Eigen::VectorXd fitted = free * free.colPivHouseholderQr().solve(dead_zone);
  EXPECT_LT((dead_zone - fitted).norm(), 1e-6);
}

TEST(Curve, TableGivesTheCurveAndItsSlope) {
  const Curve curve =
      Curve(Place::position, nullptr, spreadSamples(), 0).shaped(shapesAt(Place::position)[0]);
  ASSERT_EQ(curve.shape()->name, "cubic");
  const Eigen::VectorXd parameters = Eigen::VectorXd::Constant(1, 0.7);
  const CurveTable table = curve.table(parameters);
  for (const double z : {-1.5, -0.3, 0.0, 0.8, 1.9}) {
    int left = 0;
    double share = 0;
    const double slope = table.locate(z, &left, &share);
    const double value = (1 - share) * table.columns(0, left) + share * table.columns(0, left + 1);
    const auto at = [&](double x) {
      return curve.at(Eigen::VectorXd::Constant(1, x), parameters)[0];
    };
    EXPECT_NEAR(value, at(z), 1e-4);
    EXPECT_NEAR(slope, (at(z + 1e-3) - at(z - 1e-3)) / 2e-3, 0.02);
  }
}

TEST(Curve, FreeCurveComesCloseToEachSmoothShape) {
  const Curve place(Place::position, nullptr, spreadSamples(), 0);
  for (const Shape* shape : shapesAt(Place::position)) {
    const Curve curve = place.shaped(shape);
    const Eigen::VectorXd value = curve.atSamples(someParameters(curve));
    const Eigen::VectorXd close = place.atSamples(place.closest(value));
    EXPECT_LT((close - value).norm(), 0.35 * value.norm()) << shape->name;
  }
}

/// A dead zone about a zero that no sample comes near is only an offset.
TEST(Curve, CoversZeroWhereSamplesComeNearIt) {
  const auto covers = [](double low, double high) {
    return Curve(Place::input, nullptr, Eigen::VectorXd::LinSpaced(100, low, high), 0).coversZero();
  };
  EXPECT_TRUE(covers(-1, 3));
  EXPECT_TRUE(covers(0.1, 3));
  EXPECT_FALSE(covers(1, 3));
  EXPECT_FALSE(covers(-3, -1));
}

TEST(Curve, OfTwoLevelsIsNone) {
  Eigen::VectorXd levels(100);
  for (Eigen::Index k = 0; k < levels.size(); ++k) levels[k] = k % 2 == 0 ? 1 : -1;
  EXPECT_EQ(Curve(Place::input, nullptr, levels, 0).parameters(), 0);
}

}  // namespace
}  // namespace uncertainty_identification
