#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "uncertainty_identification/errors.h"

/// Reading YAML. Every text is checked before yaml-cpp builds a document from it. Refused are
/// nesting more than 20 deep, with which yaml-cpp 0.6 overflows the stack, and aliases (*name),
/// with which a short text stands for a huge document or for one that contains itself.
namespace uncertainty_identification {

/// YAML from a request over the network. Throws ConfigurationError for text that is longer than
/// 64 KiB, refused as above, or not YAML.
YAML::Node loadUntrustedYaml(const std::string& text);

/// A YAML file. Throws FileError when it cannot be read; ConfigurationError, with the line, when it
/// is empty, refused as above, or not YAML.
YAML::Node loadYaml(const std::string& path);

/// What `parse` makes of a YAML file; the file's name starts the message of every
/// ConfigurationError.
template <class Parse>
auto loadYamlAs(const std::string& path, const Parse& parse) {
  const YAML::Node node = loadYaml(path);
  try {
    return parse(node);
  } catch (const ConfigurationError& error) {
    throw ConfigurationError(path + ": " + error.what());
  }
}

}  // namespace uncertainty_identification
