#pragma once

#include <Eigen/Core>

namespace uncertainty_identification {

/// Pseudo-inverse of a symmetric positive semidefinite matrix. The matrices of random-effect
/// columns can be singular where outputs are missing: if the first sample is missing, for example,
/// the data do not depend on one direction of the initial state. Such directions are left out of
/// the inverse, the determinant and the rank.
struct PseudoInverse {
  /// Eigenvalues below 1e-12 of the largest count as zero. All results are NaN if the matrix
  /// contains NaN.
  explicit PseudoInverse(const Eigen::MatrixXd& matrix);

  Eigen::MatrixXd inverse;
  double log_determinant = 0;  ///< of the product of the nonzero eigenvalues
  Eigen::Index rank = 0;
};

}  // namespace uncertainty_identification
