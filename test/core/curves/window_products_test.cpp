#include "curves/window_products.h"

#include <gtest/gtest.h>

#include <cmath>

namespace uncertainty_identification {
namespace {

TEST(Orthonormal, SpansTheColumnsAndDropsThoseThatDepend) {
  Eigen::MatrixXd columns(6, 4);
  for (int row = 0; row < 6; ++row) {
    columns.row(row) << 1, row, 2 * row - 3,
        row * row;  // the third is twice the second less thrice the first
  }
  const Eigen::MatrixXd basis = orthonormal(columns);
  ASSERT_EQ(basis.cols(), 3);
  EXPECT_LT((basis.transpose() * basis - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_LT((columns - basis * (basis.transpose() * columns)).norm(), 1e-9 * columns.norm());
}

/// The products must give the error that a linear model has after any step of theta.
TEST(WindowProducts, GiveTheErrorAfterAStep) {
  SimulationWindow window;
  window.u.resize(40);
  window.y.resize(40);
  for (int k = 0; k < 40; ++k) {
    window.u[k] = std::sin(0.7 * k);
    window.y[k] = std::cos(0.31 * k);
  }
  window.measured = Eigen::ArrayXd::Ones(40);
  window.measured[11] = 0;
  window.time = Eigen::VectorXd::LinSpaced(40, 0, 1);
  CurveModel model;
  model.order = 1;
  model.theta = Eigen::Vector3d(-0.7, 0.4, 0.1);
  const Eigen::VectorXd initial = Eigen::VectorXd::Constant(1, 0.2);
  const WindowProducts products = productsOf(model, {}, window, initial, 2);
  ASSERT_EQ(products.blocks.size(), 2u);
  EXPECT_NEAR(products.total().rr, products.residual.squaredNorm(), 1e-12);
  EXPECT_LE(products.total().rr, products.squared_error);  // the initial state is fitted
  EXPECT_EQ(products.residual[11], 0);
  // The output is linear in b, so that a step of it is exact once the initial state follows.
  const Eigen::Vector3d step(0, 0.05, 0);
  CurveModel moved = model;
  moved.theta += step;
  const WindowProducts after = productsOf(moved, {}, window, initial, 2);
  EXPECT_NEAR(errorAfter(products.total(), step), after.total().rr, 1e-9);
}

}  // namespace
}  // namespace uncertainty_identification
