#pragma once

#include "inspection/following.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// `identify` tests the errors of predicting each output from all that was measured before it. Adds
/// its tests to the checks without and with the causes where one of the two models fails them.
void addFailedPredictions(Explanation* explanation);

/// Name of the check whether the input moves the output, and not the output the input.
extern const char* const kDirection;

/// Adds the check "direction" where input and output move within the same reading: if the data, not
/// the user, say that the model answers at once, the input may as well be computed from the output;
/// if it answers later, a controller probably does so.
void addUnclearDirection(const Following& following, bool delay_is_chosen,
                         Explanation* explanation);

}  // namespace uncertainty_identification
