#pragma once

#include <Eigen/Core>

namespace uncertainty_identification {

/// Frequency [1/sample], at most 0.5, below which 99.5 % of the power of the signal lies that is
/// left when a straight line through its ends is taken off; the noise floor, seen in the highest
/// quarter, is taken off, too. 0.5 for a signal without power. At least two samples, all finite.
double bandwidth(const Eigen::VectorXd& signal);

}  // namespace uncertainty_identification
