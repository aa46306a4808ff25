#pragma once

#include <vector>

namespace uncertainty_identification {

/// The different values of a signal, ascending; those that differ by the rounding of single
/// precision count as one, unless most neighbours do: then the signal moves in such small steps.
std::vector<double> levelsOf(std::vector<double> values);

/// The quantisation step of which all differences between `levels` are multiples; 0 if there is
/// none, or fewer than three levels.
double resolutionOf(const std::vector<double>& levels);

}  // namespace uncertainty_identification
