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

/// The function of given order that lies nowhere below exp(log_bound) at the angles and above it by
/// least, in the mean of the logarithm: what ucover does with a linear programme and a spectral
/// factorisation, here by unbounded reflection coefficients, from several starts. `lower` is a fit
/// of an order less to start from, and is returned, with its gain fitted anew, where no start from
/// it is stable.
MinimumPhase fitAbove(const Eigen::VectorXd& angles, const Eigen::VectorXd& log_bound, int order,
                      const MinimumPhase& lower);

}  // namespace uncertainty_identification
