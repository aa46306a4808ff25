#pragma once

#include <vector>

#include "explanation/fit.h"

namespace uncertainty_identification {

/// p-value of so many marked samples lying just behind a change of the input: of the binomial
/// distribution, if they lay anywhere. Noise does not know when the input changes; a model that
/// lacks a limit, a lag or a curve is wrong there. `marked` is 1 at the samples, one signal per
/// block; 1 where the input changes all the time, or never.
double afterInputChanges(const std::vector<Signals>& marked, const FitData& data, int delay);

/// p-value of the rank correlation between the sizes of the residuals and how much the known
/// signals, the input and covariates, have changed just before: of a normal distribution, if they
/// were independent. 1 where the correlation is negligible.
double sizeByChanges(const std::vector<Signals>& residuals, const FitData& data, int delay);

}  // namespace uncertainty_identification
