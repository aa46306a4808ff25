#include "math/pseudo_inverse.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "math/symmetric_eigen.h"

namespace uncertainty_identification {

using Eigen::MatrixXd;

PseudoInverse::PseudoInverse(const MatrixXd& matrix) : rank(matrix.rows()) {
  inverse = MatrixXd::Zero(rank, rank);
  if (rank == 0) return;
  if (!matrix.allFinite()) {
    log_determinant = std::numeric_limits<double>::quiet_NaN();
    inverse.setConstant(log_determinant);
    return;
  }
  const Eigen::LLT<MatrixXd> factor(matrix);
  const Eigen::ArrayXd pivots = factor.matrixLLT().diagonal();
  if (factor.info() == Eigen::Success &&
      (pivots.square() > 1e-10 * matrix.diagonal().array()).all()) {
    inverse = factor.solve(MatrixXd::Identity(rank, rank));
    log_determinant = 2 * pivots.log().sum();
    return;
  }
  const SymmetricEigen eigen(matrix);
  const double threshold = 1e-12 * eigen.eigenvalues()[rank - 1];
  for (Eigen::Index k = rank - 1; k >= 0; --k) {
    if (eigen.eigenvalues()[k] <= threshold) {
      rank -= k + 1;
      return;
    }
    const auto direction = eigen.eigenvectors().col(k);
    inverse += direction * direction.transpose() / eigen.eigenvalues()[k];
    log_determinant += std::log(eigen.eigenvalues()[k]);
  }
}

}  // namespace uncertainty_identification
