#pragma once

#include <string>

#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// An explanation as text for people: the verdict, which tests fail and where, each cause with its
/// parameters, its gain and what to do about it, and warnings. Several lines, ending in a newline.
std::string explanationText(const Explanation& explanation);

}  // namespace uncertainty_identification
