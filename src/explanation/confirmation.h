#pragma once

#include <optional>
#include <string>

#include "explanation/last_thirds.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// Whether the likelihood's only structural cause is the one that the free simulation showed in
/// windows of one length, and not in others. Either may be misled, but not by the same.
bool isFoundTwice(const Explanation& explanation);

/// Whether the free simulation gains by curves, and no cause is named, as all tests pass without.
bool hasUnnamedCurves(const Explanation& explanation);

/// Why a single structural cause with which all tests pass is believed although no experiment is
/// held out, in a sentence: the last thirds of the records confirm it clearly. Empty where they do
/// not.
std::string confirmationOf(const std::optional<LastThirds>& last_thirds,
                           const Explanation& explanation);

}  // namespace uncertainty_identification
