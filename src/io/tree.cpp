#include "io/tree.h"

#include <yaml-cpp/yaml.h>

#include <nlohmann/json.hpp>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;

json convert(const YAML::Node& node, const std::string& path, std::map<std::string, int>& lines);

json convertMap(const YAML::Node& node, const std::string& path,
                std::map<std::string, int>& lines) {
  json object = json::object();
  for (const auto& entry : node) {
    const std::string key = entry.first.Scalar();
    const std::string child = pathOf(path, key);
    if (object.contains(key)) {
      const int line = entry.first.Mark().line + 1;
      throw ConfigurationError(child + (line > 0 ? " (line " + std::to_string(line) + ")" : "") +
                               ": the key is given twice; keep one");
    }
    object[key] = convert(entry.second, child, lines);
    if (entry.first.Mark().line >= 0) lines[child] = entry.first.Mark().line + 1;
  }
  return object;
}

json convertSequence(const YAML::Node& node, const std::string& path,
                     std::map<std::string, int>& lines) {
  json array = json::array();
  for (const auto& entry : node) {
    const std::string child = pathOf(path, array.size());
    if (entry.Mark().line >= 0) lines[child] = entry.Mark().line + 1;
    array.push_back(convert(entry, child, lines));
  }
  return array;
}

json convert(const YAML::Node& node, const std::string& path, std::map<std::string, int>& lines) {
  if (node.IsMap()) return convertMap(node, path, lines);
  if (node.IsSequence()) return convertSequence(node, path, lines);
  if (node.IsScalar()) return node.Scalar();
  return nullptr;
}

}  // namespace

Tree treeFromYaml(const YAML::Node& node) {
  Tree tree;
  tree.value = std::make_shared<const json>(convert(node, "", tree.lines));
  return tree;
}

YAML::Node yamlFromTree(const json& value) {
  if (value.is_object()) {
    YAML::Node map(YAML::NodeType::Map);
    for (const auto& [key, entry] : value.items()) map[key] = yamlFromTree(entry);
    return map;
  }
  if (value.is_array()) {
    YAML::Node sequence(YAML::NodeType::Sequence);
    for (const auto& entry : value) sequence.push_back(yamlFromTree(entry));
    return sequence;
  }
  if (value.is_null()) return YAML::Node(YAML::NodeType::Null);
  return YAML::Node(value.is_string() ? value.get<std::string>() : value.dump());
}

std::string pathOf(const std::string& parent, const std::string& key) {
  return parent.empty() ? key : parent + "." + key;
}

std::string pathOf(const std::string& parent, std::size_t index) {
  return parent + "[" + std::to_string(index) + "]";
}

}  // namespace uncertainty_identification
