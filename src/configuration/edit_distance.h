#pragma once

#include <string>

namespace uncertainty_identification {

/// Smallest number of insertions, deletions and replacements of characters that turn one text into
/// the other.
int editDistance(const std::string& from, const std::string& to);

}  // namespace uncertainty_identification
