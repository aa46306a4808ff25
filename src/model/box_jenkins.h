#pragma once

#include <memory>

#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// The Box-Jenkins family. theta = [b; a; c; d] without the polynomials that the structure
/// determines: output_error (C = D = 1), arx (C = 1, D = A), armax (D = A), box_jenkins (none). Any
/// orders, delay >= 0. Throws ConfigurationError for negative orders or nb = 0.
std::shared_ptr<const NominalModel> makeBoxJenkins(const NominalModelOptions& options);

}  // namespace uncertainty_identification
