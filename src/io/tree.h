#pragma once

#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace YAML {
class Node;
}

namespace uncertainty_identification {

/// A YAML document as a JSON value, and where its entries stand in the file.
struct Tree {
  std::shared_ptr<const nlohmann::json> value;  ///< never null
  std::map<std::string, int> lines;  ///< line, from 1, of each path such as "nominal_model.nb"
};

/// The tree of a YAML document. Scalars stay text (1e-6 is not a number in every YAML), to be read
/// by what a key expects. Throws ConfigurationError for a key given twice.
Tree treeFromYaml(const YAML::Node& node);

/// The YAML document of a tree.
YAML::Node yamlFromTree(const nlohmann::json& value);

/// "<parent>.<key>", or the key alone at the root.
std::string pathOf(const std::string& parent, const std::string& key);

/// "<parent>[<index>]".
std::string pathOf(const std::string& parent, std::size_t index);

}  // namespace uncertainty_identification
