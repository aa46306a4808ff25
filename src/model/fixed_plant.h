#pragma once

#include <memory>

#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// A Box-Jenkins model whose Go = q^-delay B/A is known: theta = [c; d], with nc and nd
/// coefficients.
std::shared_ptr<const NominalModel> fixPlant(const Polynomials& plant, int nc, int nd);

}  // namespace uncertainty_identification
