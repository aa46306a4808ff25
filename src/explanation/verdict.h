#pragma once

#include "explanation/search.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// While some check fails, only what explains most is named, if it is no noise: what a search takes
/// in beside that, or on top of a noise that explains far more, stands in for what the catalogue
/// lacks.
bool isSymptom(const FoundCause& found, const SearchState& state);

/// Each further cause beside the noise is one less likely to be true: three that happen to describe
/// the data together are more often one that the catalogue lacks.
Check parsimony(const SearchState& state);

/// Verdict and message of an explanation with its causes and checks.
void conclude(Explanation* explanation);

}  // namespace uncertainty_identification
