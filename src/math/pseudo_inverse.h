#pragma once

#include <Eigen/Core>

namespace uncertainty_identification {

/// A symmetric positive semidefinite matrix inverted on its range. Random-effect columns are
/// linearly dependent where outputs are missing: a missing first sample hides a direction of the
/// initial state. What is not seen takes no part in the inverse, the determinant and the number of
/// columns.
struct PseudoInverse {
  /// Eigenvalues below 1e-12 of the largest count as zero. Not a number where the matrix is not.
  explicit PseudoInverse(const Eigen::MatrixXd& matrix);

  Eigen::MatrixXd inverse;
  double log_determinant = 0;  ///< of the product of the nonzero eigenvalues
  Eigen::Index rank = 0;
};

}  // namespace uncertainty_identification
