#pragma once

#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// `identify` tests the errors of predicting each output from all that was measured before it. Adds
/// its tests to the checks without and with the causes where one of the two models fails them.
void addFailedPredictions(Explanation* explanation);

}  // namespace uncertainty_identification
