#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/zero_order_hold.h"

namespace uncertainty_identification {

/// A parameter of a transfer function G(s): its name and unit in results and, by its kind, the
/// values it may take. The damping of a resonance follows its frequency in lists.
struct PhysicalParameter {
  enum Kind { gain, time_constant, frequency, damping, zero, dead_time } kind;
  std::string name, unit;
  double value;  ///< if fixed
  bool fixed;
};

/// The values of all parameters, of which those that are not fixed are the first of theta.
std::vector<double> valuesOf(const std::vector<PhysicalParameter>& physical,
                             const Eigen::VectorXd& theta);

/// Zero-order hold of G(s), exact for a dead time of any length. A state-space form with the sample
/// time [s] as unit of time is sampled; its characteristic polynomial and numerator follow by the
/// Faddeev-LeVerrier recursion. `extra`: see discretise().
Sampled<double> sampledPlant(const std::vector<PhysicalParameter>& physical,
                             const Eigen::VectorXd& theta, double sample_time, int extra);

/// d[b; a]/dtheta of sampledPlant(), exact, by dual numbers, for theta without further entries.
Eigen::MatrixXd sampledJacobian(const std::vector<PhysicalParameter>& physical,
                                const Eigen::VectorXd& theta, double sample_time, int extra);

}  // namespace uncertainty_identification
