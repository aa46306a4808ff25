#pragma once

#include <yaml-cpp/yaml.h>

#include <nlohmann/json.hpp>
#include <string>

#include "uncertainty_identification/control/robust_margin.h"

namespace uncertainty_identification {

/// The controller and what is asked of it, from a tree of keys (config/robust_margin.yaml explains
/// them); what it leaves out keeps its default. Throws ConfigurationError as parseConfiguration()
/// does, also where the controller is missing.
RobustMarginOptions parseRobustMargin(const YAML::Node& node);

/// The same from a file. Throws FileError when it cannot be read.
RobustMarginOptions loadRobustMargin(const std::string& path);

/// Every key with its value, defaults included.
nlohmann::json toJson(const RobustMarginOptions& options);

}  // namespace uncertainty_identification
