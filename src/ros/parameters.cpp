#include "ros/parameters.h"

#include <ros/names.h>

#include <array>
#include <limits>
#include <locale>
#include <sstream>

#include "io/open_simulation.h"
#include "io/tree.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/configuration_yaml.h"

namespace uncertainty_identification {
namespace {

using XmlRpc::XmlRpcValue;

// Keys in the same namespace that belong to libraries: diagnostic_updater, and actionlib for the
// node's actions.
constexpr std::array<const char*, 4> kForeignKeys = {
    "diagnostic_period", "identify_bags", "explain_experiments", "actionlib_server_pub_queue_size"};

std::string exactText(double number) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(std::numeric_limits<double>::max_digits10);
  text << number;
  return text.str();
}

YAML::Node listToYaml(XmlRpcValue& value, const std::string& path) {
  YAML::Node list(YAML::NodeType::Sequence);
  for (int i = 0; i < value.size(); ++i)
    list.push_back(toYaml(value[i], pathOf(path, static_cast<std::size_t>(i))));
  return list;
}

YAML::Node groupToYaml(XmlRpcValue& value, const std::string& path) {
  YAML::Node group(YAML::NodeType::Map);
  for (auto& [key, entry] : value) group[key] = toYaml(entry, pathOf(path, key));
  return group;
}

YAML::Node withoutForeignKeys(YAML::Node tree) {
  for (const char* key : kForeignKeys) tree.remove(key);
  return tree;
}

}  // namespace

YAML::Node toYaml(XmlRpcValue value, const std::string& path) {
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return YAML::Node(static_cast<bool>(value) ? "true" : "false");
    case XmlRpcValue::TypeInt:
      return YAML::Node(std::to_string(static_cast<int>(value)));
    case XmlRpcValue::TypeDouble:
      return YAML::Node(exactText(value));
    case XmlRpcValue::TypeString:
      return YAML::Node(static_cast<std::string>(value));
    case XmlRpcValue::TypeArray:
      return listToYaml(value, path);
    case XmlRpcValue::TypeStruct:
      return groupToYaml(value, path);
    default:
      throw ConfigurationError(path +
                               ": found a binary value, a date or nothing; allowed: true, "
                               "false, a number, text, a list or a group of keys");
  }
}

Configuration parseParameters(const XmlRpcValue& parameters) {
  Configuration configuration = parseConfiguration(withoutForeignKeys(toYaml(parameters)));
  requirePublishedSimulation(configuration);
  return configuration;
}

YAML::Node loadParameterTree(const ros::NodeHandle& node) {
  XmlRpcValue parameters;
  if (!node.getParam("", parameters) || parameters.getType() != XmlRpcValue::TypeStruct)
    return YAML::Node(YAML::NodeType::Map);
  return withoutForeignKeys(toYaml(parameters));
}

Configuration loadParameters(const ros::NodeHandle& node) {
  XmlRpcValue parameters;
  if (!node.getParam("", parameters) || parameters.getType() != XmlRpcValue::TypeStruct ||
      parameters.size() == 0) {
    throw ConfigurationError(
        "no parameters under '" + node.getNamespace() +
        "'; load a configuration there, e.g. <rosparam command=\"load\" "
        "file=\"...\"/> within <node>, at least {nominal_model: {orders: auto}}");
  }
  return parseParameters(parameters);
}

}  // namespace uncertainty_identification
