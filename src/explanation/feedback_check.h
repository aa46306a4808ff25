#pragma once

#include "explanation/fit.h"

namespace uncertainty_identification {

/// p-value of a test for a closed loop: whether the innovations correlate with the part of later
/// inputs that the past of the input does not predict (docs/explanation.md, exp_feedback). 1 where
/// there are too few samples, or where the input is predictable from its own past throughout.
double feedbackProbability(const Residuals& residuals, const FitData& data);

}  // namespace uncertainty_identification
