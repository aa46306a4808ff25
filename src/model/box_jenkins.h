#pragma once

#include <memory>

#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// The Box-Jenkins family with theta = [b; a; c; d] less what the structure fixes: output_error (C
/// = D = 1), arx (C = 1, D = A), armax (D = A), box_jenkins. Any orders, delay >= 0. Throws
/// ConfigurationError for negative orders or nb = 0.
std::shared_ptr<const NominalModel> makeBoxJenkins(const NominalModelOptions& options);

}  // namespace uncertainty_identification
