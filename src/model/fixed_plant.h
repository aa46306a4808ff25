#pragma once

#include <memory>

#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// A Box-Jenkins model whose plant Go = q^-delay B/A is fixed. theta = [c; d] with nc and nd
/// entries.
std::shared_ptr<const NominalModel> fixPlant(const Polynomials& plant, int nc, int nd);

}  // namespace uncertainty_identification
