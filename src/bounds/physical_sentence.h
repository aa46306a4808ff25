#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/bounds/physical_numbers.h"

namespace uncertainty_identification {

/// The numbers in words: "First-order plant: gain 8.2, time constant 0.2 s, no dead time, bandwidth
/// 5 rad/s."
std::string physicalSentence(const std::vector<PhysicalNumber>& numbers);

}  // namespace uncertainty_identification
