#pragma once

#include <memory>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// A sum of modes in continuous time, with zero-order hold: real poles and complex pairs, each with
/// its residue, and where `feedthrough` is set a gain that acts a sample before them:
///   G(s) = sum_k residue_k tau_k / (1 + tau_k s)
///        + sum_k 2 Re[amplitude_k e^(j phase_k) / (s - p_k)], with complex conjugates combined,
///   p_k = omega_k (-zeta_k + j sqrt(1 - zeta_k^2))
/// and a noise model C/D with nc and nd coefficients. Every transfer function without multiple
/// poles has this form, whatever its zeros, and each parameter belongs to one mode. theta holds tau
/// and residue of each real pole; omega, zeta, amplitude and phase of each pair; the feedthrough; c
/// and d. `delay` [samples] is that of the first coefficient of B: the modes answer one sample
/// after a feedthrough. With `directions` theta holds a factor for each parameter, as
/// NominalModelOptions says. Throws ConfigurationError without poles, with delay 0 and no
/// feedthrough, or where the directions are singular.
std::shared_ptr<const NominalModel> makeModal(const NominalModelOptions& options,
                                              double sample_time);

/// Whether the plants of a configuration differ along directions: its error model varies factors of
/// a modal structure.
bool variesAlongDirections(const Configuration& configuration);

/// The parameters of the modes that theta stands for, with their names: theta itself without c and
/// d, unless the options have directions. Empty for options of another structure.
struct ModalParameters {
  std::vector<std::string> names;
  Eigen::VectorXd values;
  Eigen::MatrixXd by_theta;  ///< derivatives of the values with respect to theta without c and d
};
ModalParameters modalParameters(const NominalModelOptions& options, double sample_time,
                                const Eigen::VectorXd& theta);

}  // namespace uncertainty_identification
