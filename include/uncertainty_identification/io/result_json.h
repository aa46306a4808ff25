#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "uncertainty_identification/baselines/baseline.h"
#include "uncertainty_identification/bounds/bounds.h"
#include "uncertainty_identification/bounds/physical_numbers.h"
#include "uncertainty_identification/bounds/simulated_runs.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// The estimate as result.json holds it ("format": "uncertainty_identification/result/1"). Numbers
/// that are not finite are null; all others keep every bit. "bounds" is an empty object, because an
/// estimate has none.
nlohmann::json toJson(const Estimate& estimate);

/// The estimate that toJson() wrote; null is NaN. Throws ConfigurationError, naming the field, for
/// another format or version, a missing field or a wrong type.
Estimate estimateFromJson(const nlohmann::json& json);

/// When a result was made, and from what.
struct Origin {
  std::string date;                           ///< UTC, "2026-03-14 15:09"
  std::vector<std::string> data, validation;  ///< the names of the files or folders
};

/// What a result.json holds. Results of older versions lack `physical`, `runs` and `origin`.
struct Result {
  Estimate estimate;
  std::optional<Bounds> bounds;
  std::optional<Baseline> baseline = std::nullopt;  ///< identify --method pem or mem
  PhysicalNumbers physical = {};
  std::vector<SimulatedRun> runs = {};
  Origin origin = {};
};

/// The content of result.json as JSON.
nlohmann::json toJson(const Result& result);

/// Writes result.json, which appears complete or not at all. Throws FileError.
void saveResult(const std::string& path, const Result& result);

/// Reads result.json. Throws FileError when it cannot be read, ConfigurationError when it is not
/// such a result.
Result loadResult(const std::string& path);

}  // namespace uncertainty_identification
