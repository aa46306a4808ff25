#pragma once

#include <vector>

#include "explanation/fit.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// Tests of what a fit leaves of its data: whiteness, squares, variance over time, tails, symmetry,
/// dependence on the input and on generic nonlinear features of it, dependence on the experiments.
/// `heavy_tails` were named: tests of the distribution's shape are left out.
std::vector<Check> checksOf(const Fit& fit, const FitData& data, bool heavy_tails);

/// p-value below which a check counts as failed: tests are few, data sets many.
constexpr double kCheckThreshold = 1e-6;

bool allPassed(const std::vector<Check>& checks);

/// Whether the innovations correlate with what of later inputs those inputs' own past does not
/// predict: a closed loop (effects.md, section on feedback). Returns the p-value.
double feedbackProbability(const Residuals& residuals, const FitData& data);

/// What the report draws.
ResidualPicture residualPicture(const Fit& fit, const FitData& data);

}  // namespace uncertainty_identification
