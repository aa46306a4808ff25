#pragma once

#include <yaml-cpp/yaml.h>

#include <nlohmann/json.hpp>
#include <string>

#include "detection/live_fault_detector.h"

namespace uncertainty_identification {

/// The configuration of a fault detector that a tree of keys describes (config/fault_detection.yaml
/// explains them); what it leaves out keeps its default. Throws ConfigurationError as
/// parseConfiguration() does.
FaultDetectionConfiguration parseFaultDetection(const YAML::Node& node);

/// The same from a file. Throws FileError when it cannot be read.
FaultDetectionConfiguration loadFaultDetection(const std::string& path);

/// Every key with its value, defaults included.
nlohmann::json toJson(const FaultDetectionConfiguration& configuration);

}  // namespace uncertainty_identification
