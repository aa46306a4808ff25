#pragma once

#include <Eigen/Core>

namespace uncertainty_identification {

/// Eigenvalues, ascending, and eigenvectors of a symmetric matrix, of which the lower triangle is
/// read. One place, because every source that instantiates Eigen's solver compiles seconds longer.
class SymmetricEigen {
 public:
  /// A = V diag(eigenvalues) V', V orthogonal.
  explicit SymmetricEigen(const Eigen::MatrixXd& matrix);

  /// The generalised problem: A v = lambda B v for a positive definite B, V' B V = I.
  SymmetricEigen(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& metric);

  const Eigen::VectorXd& eigenvalues() const { return eigenvalues_; }
  const Eigen::MatrixXd& eigenvectors() const { return eigenvectors_; }  ///< V, a column each
  bool converged() const { return converged_; }

 private:
  Eigen::VectorXd eigenvalues_;
  Eigen::MatrixXd eigenvectors_;
  bool converged_;
};

}  // namespace uncertainty_identification
