#pragma once

#include <Eigen/Core>
#include <vector>

/// Converts vectors and matrices to arrays of messages.
namespace uncertainty_identification {

inline std::vector<double> toList(const Eigen::VectorXd& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

inline std::vector<double> toRowMajor(const Eigen::MatrixXd& matrix) {
  const Eigen::MatrixXd transposed = matrix.transpose();
  return {transposed.data(), transposed.data() + transposed.size()};
}

}  // namespace uncertainty_identification
