#pragma once

#include <memory>

#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// A continuous-time transfer function with zero-order hold and physical parameters:
///   G(s) = gain e^(-dead_time s) prod(1 + zero_k s) / (prod(1 + tau_k s) prod(1 + 2 zeta_k
///   s/omega_k + s^2/omega_k^2))
/// and a noise model C/D with nc and nd coefficients. theta holds the physical parameters that are
/// not fixed, then c and d. Example: the resistor-capacitor circuit (39) of the paper is
/// {time_constants: 1, fixed: {gain: 1}}. `delay` [samples] includes the one sample of the hold;
/// what exceeds it adds to dead_time. Throws ConfigurationError if the transfer function is not
/// strictly proper or `fixed` contains an unknown name.
std::shared_ptr<const NominalModel> makeContinuous(const NominalModelOptions& options,
                                                   double sample_time);

/// Largest dead time [samples] that a continuous model can have; 0 where none is estimated, and for
/// any other model.
int longestDeadTime(const NominalModel& model);

}  // namespace uncertainty_identification
