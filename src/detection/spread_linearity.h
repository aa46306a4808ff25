#pragma once

#include <memory>

#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// How much of the differences between the plants of a result with `parameter_spread` is not linear
/// in xi: norm of what the first order lacks, divided by that of the differences, over the
/// frequency responses one standard deviation away along each axis of the mixture. 1 where such a
/// plant does not exist.
double shareBeyondFirstOrder(const Estimate& estimate, std::shared_ptr<const NominalModel> nominal);

}  // namespace uncertainty_identification
