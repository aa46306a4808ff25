#pragma once

#include <Eigen/Core>
#include <vector>

#include "uncertainty_identification/own_simulation/simulation.h"
#include "uncertainty_identification/own_simulation_options.h"

namespace uncertainty_identification {

/// A transfer function in factors that have physical parameters, and one that has none:
///
///   gain e^(-dead_time s) rest(s) prod(1 + zero_k s) / (s^integrators prod(1 + tau_k s)
///     prod(1 + 2 zeta_k s/omega_k + s^2/omega_k^2))
///
/// In domain z the poles are those of the sampled poles e^(pole sample_time), and the numerator is
/// fixed but for its gain.
struct LinearFactors {
  TransferDomain domain = TransferDomain::s;
  std::vector<SimulationParameter>
      parameters;  ///< gain, tau1.., omega1, zeta1.., zero1.., dead_time
  Eigen::VectorXd fixed_numerator = Eigen::VectorXd::Ones(1);    ///< ascending powers of s or z^-1
  Eigen::VectorXd fixed_denominator = Eigen::VectorXd::Ones(1);  ///< likewise
  int delay = 0;                                                 ///< [samples] domain z
  double sample_time = 0;                                        ///< [s] domain z
};

/// The factors of simulation.model. `sample_time` [s] is that of the data. Throws
/// ConfigurationError for a model that is unstable, improper or not readable.
LinearFactors factorsOf(const OwnModelOptions& options, double sample_time);

}  // namespace uncertainty_identification
