#pragma once

#include <Eigen/Core>
#include <functional>

namespace uncertainty_identification {

/// The derivatives of a function with respect to the first `count` entries of its argument, by
/// central differences: entries of its value x `count`.
Eigen::MatrixXd centralDifferences(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& function,
    const Eigen::VectorXd& at, Eigen::Index count);

}  // namespace uncertainty_identification
