#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "simulation/truth.h"

namespace uncertainty_identification {

/// The truth that a tree of keys describes (config/example1_truth.yaml shows them); what it leaves
/// out keeps its default. Throws ConfigurationError as parseConfiguration() does.
Truth parseTruth(const YAML::Node& node);

/// The same from a file. Throws FileError when it cannot be read.
Truth loadTruth(const std::string& path);

/// Every key with its value; reading it back gives an equal truth.
nlohmann::json toJson(const Truth& truth);

/// What an identification of simulate(truth, seed) should find: {"format":
/// "uncertainty_identification/answer/1", "version", "seed", "truth", "experiments": [{"id",
/// "component", "xi", "time_constant", "effects": {...}}]}, component and time_constant null and xi
/// empty where the truth has none; under "effects" what was drawn for the experiment (EffectDraws),
/// 0 where the truth does not hide the effect. What is hidden, with its parameters, is
/// truth.effects.
nlohmann::json answerJson(const Truth& truth, std::uint64_t seed);

}  // namespace uncertainty_identification
