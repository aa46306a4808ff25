#include "uncertainty_identification/io/configuration_yaml.h"

#include "io/configuration_binding.h"
#include "io/tree.h"
#include "io/tree_reader.h"
#include "io/tree_writer.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

Configuration fromTree(const Tree& tree) {
  Configuration configuration;
  TreeReader reader(tree.value, tree.lines, ReadingRule::configuration);
  bind(reader, configuration);
  reader.finish();
  configuration.validate();
  return configuration;
}

}  // namespace

Configuration parseConfiguration(const YAML::Node& node) { return fromTree(treeFromYaml(node)); }

Configuration loadConfiguration(const std::string& path) {
  return loadYamlAs(path, parseConfiguration);
}

Configuration configurationFromJson(const nlohmann::json& json) { return fromTree({json, {}}); }

nlohmann::json toJson(const Configuration& configuration) {
  Configuration copy = configuration;
  TreeWriter writer;
  bind(writer, copy);
  return writer.tree();
}

YAML::Node toYaml(const Configuration& configuration) {
  return yamlFromTree(toJson(configuration));
}

}  // namespace uncertainty_identification
