#pragma once

#include <vector>

#include "explanation/fit.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// Parameters of an effect with standard errors and 90 % intervals. They follow from the observed
/// information where the likelihood is smooth in the parameter. Elsewhere the interval contains the
/// values at which the log-likelihood is less than 1.35 nats below its maximum (half the 90 %
/// quantile of chi-squared with one degree of freedom), the other parameters being fixed. Empty
/// where the effect is no part of the fit's model.
std::vector<CauseParameter> parametersOf(const Fit& fit, const FitData& data,
                                         const std::shared_ptr<const Effect>& effect);

}  // namespace uncertainty_identification
