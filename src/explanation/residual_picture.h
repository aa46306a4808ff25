#pragma once

#include "explanation/fit.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// What the report's figures show of the residuals of a fit: correlations, spectrum, and means over
/// bins of the input, of the simulated output and of time.
ResidualPicture residualPicture(const Fit& fit, const FitData& data);

}  // namespace uncertainty_identification
