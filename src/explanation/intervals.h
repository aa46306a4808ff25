#pragma once

#include <vector>

#include "explanation/fit.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// Parameters of an effect of the fit's model with standard errors and 90 % intervals: from the
/// scoring information where the likelihood is smooth, else those that the likelihood drops less
/// than 1.35 nats within.
std::vector<CauseParameter> parametersOf(const Fit& fit, const FitData& data,
                                         const std::shared_ptr<const Effect>& effect);

}  // namespace uncertainty_identification
