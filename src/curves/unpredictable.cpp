#include "curves/unpredictable.h"

#include <Eigen/Cholesky>
#include <limits>

namespace uncertainty_identification {

double unpredictableShare(const WindowFit& fit) {
  using Eigen::Index;
  constexpr Index kOrder = 10, kFewestRows = 20 * kOrder;
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(kOrder + 1, kOrder + 1);
  Index rows = 0;
  for (const Eigen::VectorXd& residual : fit.residuals) {
    for (Index t = kOrder; t < residual.size(); ++t, ++rows)
      products.selfadjointView<Eigen::Lower>().rankUpdate(
          residual.segment(t - kOrder, kOrder + 1).reverse());
  }
  const double power = products(0, 0);
  if (rows < kFewestRows || !(power > 0)) return std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd past = products.bottomRightCorner(kOrder, kOrder).selfadjointView<Eigen::Lower>();
  past.diagonal() *= 1 + 1e-9;
  const Eigen::VectorXd with = products.bottomLeftCorner(kOrder, 1);
  return 1 - with.dot(past.ldlt().solve(with)) / power;
}

}  // namespace uncertainty_identification
