#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// The explanation as explanation.json holds it ("format":
/// "uncertainty_identification/explanation/1"; docs/explanation.md explains the keys). "model" is
/// the model with the causes as result.json holds it, "model_before" the one without. Numbers that
/// are not finite are null; all others keep every bit.
nlohmann::json toJson(const Explanation& explanation);

/// The explanation that toJson() wrote; null is NaN. Throws ConfigurationError, naming the field,
/// for another format or version, a missing field or a wrong type.
Explanation explanationFromJson(const nlohmann::json& json);

/// Writes explanation.json, all of it or nothing. Throws FileError.
void saveExplanation(const std::string& path, const Explanation& explanation);

/// Reads explanation.json. Throws FileError when it cannot be read, ConfigurationError when it
/// holds no such explanation.
Explanation loadExplanation(const std::string& path);

}  // namespace uncertainty_identification
