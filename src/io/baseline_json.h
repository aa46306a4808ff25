#pragma once

#include <nlohmann/json.hpp>

#include "uncertainty_identification/baselines/baseline.h"

namespace uncertainty_identification {

/// A baseline as result.json holds it under "baseline".
nlohmann::json toJson(const Baseline& baseline);

/// The baseline that toJson() wrote. Throws ConfigurationError, naming the field, for a missing
/// field or a wrong type.
Baseline baselineFromJson(const nlohmann::json& json);

}  // namespace uncertainty_identification
