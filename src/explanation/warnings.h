#pragma once

#include <string>
#include <vector>

#include "explanation/search_outcome.h"

/// Warnings about the model that is explained.
namespace uncertainty_identification {

/// The likelihood asks for other orders than those that the simulation chose, an orderText().
/// Empty: it does not.
std::string otherOrdersWarning(const std::string& chosen, const Estimate& explained);

/// The sensor's steps are a noticeable share of the noise variance, and not most of it.
std::string quantisationRemark(double step, double share);

/// On top of other orders, other causes explain the data as well. Empty: they do not.
std::string tieWarning(const SearchOutcome& other, const SearchOutcome& best);

/// What the simulation of held-out experiments refused.
std::vector<std::string> refusalWarnings(const SearchOutcome& best);

extern const char* const kNothingHeldOut;
extern const char* const kOutOfTime;
extern const char* const kFeedback;
extern const char* const kMayBeFeedback;

}  // namespace uncertainty_identification
