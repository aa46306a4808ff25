#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace uncertainty_identification {

/// YAML from someone who may mean harm, as in a request over the network. Throws ConfigurationError
/// when the text is no YAML, longer than 64 KiB, nested more than 20 deep (yaml-cpp 0.6 overflows
/// the stack), or has aliases, which let a short text stand for a huge one.
YAML::Node loadUntrustedYaml(const std::string& text);

}  // namespace uncertainty_identification
