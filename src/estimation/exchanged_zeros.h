#pragma once

#include <vector>

#include "estimation/likelihood.h"
#include "model/linear_model.h"

namespace uncertainty_identification {

/// Points at which zeros of B and of the mean of 1 + GDelta have changed places. The mean system is
/// the same, so such points may lie near other local optima; which zeros are common to all
/// experiments shows only in how these differ. The mixture is carried over so that every
/// B (1 + GDelta) is kept as well as possible. Empty where B's coefficients are not free, or where
/// the error model has no FIR basis or its mean is zero.
std::vector<ModelParameters> withExchangedZeros(const LinearModel& model, const ModelParameters& at,
                                                Constraint constraint);

}  // namespace uncertainty_identification
