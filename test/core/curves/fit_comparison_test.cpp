#include "curves/fit_comparison.h"

#include <gtest/gtest.h>

#include <vector>

namespace uncertainty_identification {
namespace {

constexpr double kLeastGain = 0.08, kLeastT = 1.7;

bool convinced(const std::vector<double>& before, const std::vector<double>& after,
               std::size_t windows) {
  const auto vector = [](const std::vector<double>& values) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXd>(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
  };
  return convinces(vector(before), vector(after), windows, {kLeastGain, kLeastT});
}

TEST(Convinces, HalfOfTheErrorOfFewWindowsThoughItIsNotSignificant) {
  // One window holds nearly all of the error: Student's t is 1.0, of the logarithms 1.1.
  const std::vector<double> before{100, 2, 1}, halved{48, 2.1, 0.9}, less{60, 2.1, 0.9};
  EXPECT_TRUE(convinced(before, halved, 3));
  EXPECT_FALSE(convinced(before, less, 3)) << "more than half is left";
}

TEST(Convinces, OfManyWindowsOnlyWhatIsSignificant) {
  const std::vector<double> before{100, 2, 1, 2, 1}, halved{40, 2.3, 1.1, 2.3, 1.1};
  EXPECT_FALSE(convinced(before, halved, 5)) << "one window gains, the others lose";
  const std::vector<double> equal{10, 11, 9, 10, 11}, all_gain{8, 9, 7, 8, 9};
  EXPECT_TRUE(convinced(equal, all_gain, 5));
}

TEST(Convinces, NoGainThatIsSmall) {
  const std::vector<double> before{10, 11, 9, 10, 11}, after{9.5, 10.4, 8.6, 9.5, 10.4};
  EXPECT_FALSE(convinced(before, after, 5)) << "significant, but only a twentieth";
}

TEST(Convinces, WhereThereIsNothingToCompare) { EXPECT_TRUE(convinced({}, {}, 0)); }

/// A fit that ends with a curve of so many standard errors, behind a plant of one that is certain.
WindowFit endsWith(double errors) {
  WindowFit fit;
  fit.model.curves = {Curve(Place::play)};
  fit.model.theta = Eigen::Vector2d(0.9, -0.2 * errors);
  fit.covariance = Eigen::Vector2d(1e-6, 0.04).asDiagonal();
  return fit;
}

TEST(IsSignificant, AsksForThreeStandardErrorsOfEachCurve) {
  EXPECT_TRUE(isSignificant(endsWith(3.1)));
  EXPECT_FALSE(isSignificant(endsWith(2.9)));
  WindowFit of_two = endsWith(2.9);
  of_two.model.curves.push_back(Curve(Place::rate_limit));
  of_two.model.theta = Eigen::Vector3d(0.9, -0.2 * 2.9, 0.1);
  of_two.covariance = Eigen::Vector3d(1e-6, 0.04, 1e-6).asDiagonal();
  EXPECT_FALSE(isSignificant(of_two)) << "the first one is not";
  of_two.model.theta[1] = -0.2 * 3.1;
  EXPECT_TRUE(isSignificant(of_two));
}

}  // namespace
}  // namespace uncertainty_identification
