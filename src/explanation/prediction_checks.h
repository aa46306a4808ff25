#pragma once

#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// Adds the tests that `identify` makes of its residuals, those of predicting each output from what
/// was measured before, to the checks without and with the causes: those that one of the two models
/// fails. Its residuals hold what the noise model would otherwise describe.
void addFailedPredictions(Explanation* explanation);

}  // namespace uncertainty_identification
