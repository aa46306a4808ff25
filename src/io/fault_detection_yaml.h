#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "detection/live_fault_detector.h"

namespace uncertainty_identification {

class Archive;

/// The configuration of a fault detector that a tree of keys describes (config/fault_detection.yaml
/// explains them); what it leaves out keeps its default. Throws ConfigurationError as
/// parseConfiguration() does.
FaultDetectionConfiguration parseFaultDetection(const YAML::Node& node);

/// The same from a file. Throws FileError when it cannot be read.
FaultDetectionConfiguration loadFaultDetection(const std::string& path);

/// The keys, for reading and for writing.
void bind(Archive& archive, FaultDetectionConfiguration& configuration);

}  // namespace uncertainty_identification
