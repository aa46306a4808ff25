#pragma once

#include <yaml-cpp/yaml.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

/// A document of keys and values, whether it was YAML or JSON, and where its entries stand in the
/// file.
struct Tree {
  nlohmann::json value;
  std::map<std::string, int>
      lines;  ///< of each path such as "nominal_model.nb", from 1; empty = not known
};

/// The tree of a YAML document. Scalars stay text (1e-6 is not a number in every YAML), to be read
/// by what a key expects. Throws ConfigurationError for a key given twice.
Tree treeFromYaml(const YAML::Node& node);

/// The YAML document of a tree.
YAML::Node yamlFromTree(const nlohmann::json& value);

/// Reads a YAML file. Throws FileError when it cannot be read, ConfigurationError with the line
/// when it is not YAML or empty.
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

/// "<parent>.<key>", or the key alone at the root.
std::string pathOf(const std::string& parent, const std::string& key);

/// "<parent>[<index>]".
std::string pathOf(const std::string& parent, std::size_t index);

}  // namespace uncertainty_identification
