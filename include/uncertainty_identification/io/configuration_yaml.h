#pragma once

#include <yaml-cpp/yaml.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// The configuration that a tree of keys describes; what it leaves out keeps its default. Numbers
/// may be text ("1e-6"), as rosparam hands them over. Throws ConfigurationError naming key, line
/// where known, value and what is allowed for an unknown key (with the nearest known one), a wrong
/// type, or a value out of range.
Configuration parseConfiguration(const YAML::Node& node);

/// The same from a file, whose name starts every message. Throws FileError when it cannot be read.
Configuration loadConfiguration(const std::string& path);

/// The same from JSON, as in result.json.
Configuration configurationFromJson(const nlohmann::json& json);

/// Every key with its value, defaults included. Reading it back gives an equal configuration, to
/// the last bit.
nlohmann::json toJson(const Configuration& configuration);

/// The same as YAML.
YAML::Node toYaml(const Configuration& configuration);

}  // namespace uncertainty_identification
