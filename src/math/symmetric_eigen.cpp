#include "math/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace uncertainty_identification {

using Eigen::MatrixXd;

SymmetricEigen::SymmetricEigen(const MatrixXd& matrix) {
  converged_ = true;
  if (matrix.size() == 0) return;  // Eigen's solver reads the first entry
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(matrix);
  eigenvalues_ = solver.eigenvalues();
  eigenvectors_ = solver.eigenvectors();
  converged_ = solver.info() == Eigen::Success;
}

SymmetricEigen::SymmetricEigen(const MatrixXd& matrix, const MatrixXd& metric) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(matrix, metric);
  eigenvalues_ = solver.eigenvalues();
  eigenvectors_ = solver.eigenvectors();
  converged_ = solver.info() == Eigen::Success;
}

}  // namespace uncertainty_identification
