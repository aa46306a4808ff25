#include "uncertainty_identification/io/configuration_yaml.h"

#include <nlohmann/json.hpp>

#include "io/configuration_binding.h"
#include "io/tree_reader.h"
#include "io/tree_writer.h"
#include "io/untrusted_yaml.h"

namespace uncertainty_identification {

Configuration parseConfiguration(const YAML::Node& node) {
  return readYamlConfiguration<Configuration>(node);
}

Configuration loadConfiguration(const std::string& path) {
  return loadYamlAs(path, parseConfiguration);
}

Configuration configurationFromJson(const nlohmann::json& json) {
  return readConfiguration<Configuration>(json);
}

nlohmann::json toJson(const Configuration& configuration) { return writtenTree(configuration); }

YAML::Node toYaml(const Configuration& configuration) {
  return yamlFromTree(toJson(configuration));
}

}  // namespace uncertainty_identification
