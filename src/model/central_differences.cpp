#include "model/central_differences.h"

#include <algorithm>
#include <cmath>

namespace uncertainty_identification {

Eigen::MatrixXd centralDifferences(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& function,
    const Eigen::VectorXd& at, Eigen::Index count) {
  Eigen::MatrixXd jacobian(function(at).size(), count);
  Eigen::VectorXd beside = at;
  for (Eigen::Index j = 0; j < count; ++j) {
    const double step = 6e-6 * std::max(std::abs(at[j]), 1e-3);  // cube root of the rounding error
    const double high = at[j] + step, low = at[j] - step;
    beside[j] = high;
    jacobian.col(j) = function(beside);
    beside[j] = low;
    jacobian.col(j) -= function(beside);
    jacobian.col(j) /= high - low;
    beside[j] = at[j];
  }
  return jacobian;
}

}  // namespace uncertainty_identification
