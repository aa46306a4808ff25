#pragma once

#include "explanation/fit.h"

namespace uncertainty_identification {

/// p-value of a test for a closed loop: whether the part of the residuals that their own past does
/// not predict correlates with that part of the next four inputs (docs/explanation.md,
/// exp_feedback). 1 where it correlates as much with much later inputs, where there are too few
/// samples, or where a signal is predictable from its own past throughout.
double feedbackProbability(const Residuals& residuals, const FitData& data);

}  // namespace uncertainty_identification
