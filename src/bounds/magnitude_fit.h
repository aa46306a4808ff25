#pragma once

#include <Eigen/Core>

namespace uncertainty_identification {

/// A stable, minimum-phase rational function gain N/D in z^-1, N and D monic and stored without
/// their leading 1.
struct MinimumPhase {
  double gain = 1;
  Eigen::VectorXd n, d;

  int order() const { return static_cast<int>(d.size()); }

  /// log |gain N/D| at the angles [rad/sample].
  Eigen::ArrayXd logMagnitude(const Eigen::VectorXd& angles) const;
};

/// Finds the function of the given order that is nowhere below exp(log_bound) at the angles
/// [rad/sample] and exceeds it least, in the mean of the logarithm. MATLAB's ucover does this by a
/// linear programme and a spectral factorisation; here an unconstrained optimisation over
/// reflection coefficients runs from several starts. `lower` is a fit of order one less; it serves
/// as a start, and is returned with a new gain if no start gives a stable function.
MinimumPhase fitAbove(const Eigen::VectorXd& angles, const Eigen::VectorXd& log_bound, int order,
                      const MinimumPhase& lower);

}  // namespace uncertainty_identification
