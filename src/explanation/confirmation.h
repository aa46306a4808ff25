#pragma once

#include <optional>
#include <string>

#include "explanation/last_thirds.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// Whether the likelihood's only structural cause is the one that the free simulation showed in
/// windows of one length, and not in others. Either may be misled, but not by the same.
bool isFoundTwice(const Explanation& explanation);

/// Why that cause is believed although no experiment is held out, in a sentence: all tests pass
/// with it and the last thirds of the records confirm it clearly, or it was found twice. Empty
/// where neither is so.
std::string confirmationOf(const std::optional<LastThirds>& last_thirds,
                           const Explanation& explanation);

}  // namespace uncertainty_identification
