#pragma once

#include <vector>

#include "explanation/fit.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// Tests of the residuals of a fit: whiteness; dependence on the input and on nonlinear features of
/// it; variance over time; correlation of the squares (volatility); kurtosis (tails) and symmetry
/// of the distribution; variance over the experiments. With `heavy_tails` the model already has a
/// residual distribution other than a Gaussian, or the output is coarsely quantised; only the first
/// three tests are then done, as the others would see the same again.
std::vector<Check> checkResiduals(const Fit& fit, const FitData& data, bool heavy_tails);

/// p-value below which a check fails. It is this small because a data set shows many things that no
/// model describes, and because several tests are done on each of many data sets.
constexpr double kCheckThreshold = 1e-6;

bool allPassed(const std::vector<Check>& checks);

}  // namespace uncertainty_identification
