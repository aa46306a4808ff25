#pragma once

#include <string>

#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// An explanation for people, to be read in ten seconds: the verdict, which tests fail and where,
/// each cause with its parameters and what it gains, what to do about it, and warnings. Several
/// lines, ending in a newline.
std::string explanationText(const Explanation& explanation);

}  // namespace uncertainty_identification
