#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "uncertainty_identification/control/robust_margin.h"

namespace uncertainty_identification {

class Archive;

/// The controller and what is asked of it, from a tree of keys (config/robust_margin.yaml explains
/// them); what it leaves out keeps its default. Throws ConfigurationError as parseConfiguration()
/// does, also where the controller is missing.
RobustMarginOptions parseRobustMargin(const YAML::Node& node);

/// The same from a file. Throws FileError when it cannot be read.
RobustMarginOptions loadRobustMargin(const std::string& path);

/// The keys, for reading and for writing.
void bind(Archive& archive, RobustMarginOptions& options);

}  // namespace uncertainty_identification
