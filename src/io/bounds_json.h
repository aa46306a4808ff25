#pragma once

#include <nlohmann/json_fwd.hpp>

#include "uncertainty_identification/bounds/bounds.h"

namespace uncertainty_identification {

/// The bounds as result.json holds them under "bounds" (docs/bounds.md explains the keys). Bands
/// are rounded to six digits, more than their Monte Carlo error leaves; W keeps every bit.
nlohmann::json toJson(const Bounds& bounds);

/// The bounds that toJson() wrote. Throws ConfigurationError, naming the field, for a missing field
/// or a wrong type.
Bounds boundsFromJson(const nlohmann::json& json);

/// Rounds all numbers that are not integers to so many significant digits, in place.
void roundNumbers(nlohmann::json* tree, int digits);

}  // namespace uncertainty_identification
