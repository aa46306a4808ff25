#include "own_simulation/output_filters.h"

#include <gtest/gtest.h>

#include <cmath>

namespace uncertainty_identification {
namespace {

Eigen::VectorXd sine(double late) {
  Eigen::VectorXd y(200);
  for (Eigen::Index k = 0; k < y.size(); ++k)
    y[k] = std::sin(0.2 * (static_cast<double>(k) - late));
  return y;
}

TEST(OutputFilters, DelaysByPartsOfASample) {
  for (const double delay : {0.0, 0.3, 2.0, 7.75, -1.4}) {
    const Eigen::VectorXd error = delayedOutput(sine(0), delay) - sine(delay);
    EXPECT_LT(error.segment(10, 180).cwiseAbs().maxCoeff(), 1e-3) << delay;
  }
  EXPECT_EQ(delayedOutput(Eigen::Vector3d(5, 6, 7), 2), Eigen::Vector3d(5, 5, 5));
  EXPECT_EQ(delayedOutput(Eigen::Vector3d(5, 6, 7), -2), Eigen::Vector3d(7, 7, 7));
}

TEST(OutputFilters, LagsARampByItsTimeConstant) {
  const Eigen::VectorXd ramp = Eigen::VectorXd::LinSpaced(200, 0, 199);
  EXPECT_NEAR(leadLag(ramp, 0, 6)[199], 193, 1e-9);
  EXPECT_NEAR(leadLag(ramp, 2.5, 6)[199], 195.5, 1e-9);
  EXPECT_EQ(leadLag(Eigen::VectorXd::Constant(5, 3), 1, 4), Eigen::VectorXd::Constant(5, 3));
}

TEST(OutputFilters, EqualTimeConstantsChangeNothing) {
  EXPECT_LT((leadLag(sine(0), 4, 4) - sine(0)).norm(), 1e-12);
  EXPECT_LT((leadLag(sine(0), 0, 0) - sine(0)).cwiseAbs().maxCoeff(), 0.01);
}

}  // namespace
}  // namespace uncertainty_identification
