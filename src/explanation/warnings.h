#pragma once

#include <string>
#include <vector>

#include "explanation/search_outcome.h"

/// Warnings about the model that is explained.
namespace uncertainty_identification {

/// The sensor's steps are a noticeable share of the noise variance, and not most of it.
std::string quantisationRemark(double step, double share);

/// What is to be said of the outcome that was chosen, beside others: that its model was simplified
/// or has other orders than the likelihood asks for, that other causes explain the data as well on
/// top of other orders, and what the simulation of held-out experiments refused.
std::vector<std::string> warningsOf(const SearchOutcome& best,
                                    const std::vector<SearchOutcome>& outcomes);

extern const char* const kNothingHeldOut;
extern const char* const kOutOfTime;
extern const char* const kLineAsPoles;
extern const char* const kFeedback;
extern const char* const kMayBeFeedback;

}  // namespace uncertainty_identification
