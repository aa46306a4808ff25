#pragma once

#include <string>
#include <vector>

#include "explanation/search_outcome.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// Whether a cause was found in the samples themselves or by a test of the input: no curve can
/// imitate it.
bool isOfSamples(const Cause& cause);

/// Whether a cause is neither of the noise nor a defect of samples.
bool isStructural(const Cause& cause);

/// "sens_hum, act_delay".
std::string namesOf(const std::vector<Cause>& causes);

/// Makes the model with causes the one without.
void forgetModelWithCauses(Explanation* explanation);

/// A cause that the likelihood found. Without a probability where the search had no time for
/// others.
Cause described(const FoundCause& found, const SearchState& state, bool in_time);

}  // namespace uncertainty_identification
