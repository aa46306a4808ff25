#pragma once

#include <memory>

#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// A continuous-time transfer function with zero-order hold, parametrised physically:
///   G(s) = gain e^(-dead_time s) prod(1 + zero_k s) / (prod(1 + tau_k s) prod(1 + 2 zeta_k
///   s/omega_k + s^2/omega_k^2))
/// with the noise model C/D of nc and nd coefficients. theta = the physical parameters that are not
/// fixed, then c, d. The paper's resistor-capacitor circuit (39) is {time_constants: 1, fixed:
/// {gain: 1}}. `delay` [samples] beyond the hold's one sample counts on top of dead_time. Throws
/// ConfigurationError for a transfer function that is not strictly proper, or an unknown name in
/// `fixed`.
std::shared_ptr<const NominalModel> makeContinuous(const NominalModelOptions& options,
                                                   double sample_time);

}  // namespace uncertainty_identification
