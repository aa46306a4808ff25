#include "io/robust_margin_yaml.h"

#include "io/tree.h"
#include "io/tree_reader.h"
#include "io/tree_writer.h"

namespace uncertainty_identification {

template <class Archive>
void bind(Archive& archive, RobustMarginOptions& options) {
  archive.section("controller", [&options](auto& section) {
    section("num", options.controller.num);
    section("den", options.controller.den);
  });
  archive("minimum_margin", options.minimum_margin);
  archive("samples", options.samples);
  archive("seed", options.seed);
}

RobustMarginOptions parseRobustMargin(const YAML::Node& node) {
  const Tree tree = treeFromYaml(node);
  RobustMarginOptions options;
  TreeReader reader(tree.value, tree.lines, ReadingRule::configuration);
  bind(reader, options);
  reader.finish();
  options.validate();
  return options;
}

RobustMarginOptions loadRobustMargin(const std::string& path) {
  return loadYamlAs(path, parseRobustMargin);
}

nlohmann::json toJson(const RobustMarginOptions& options) {
  RobustMarginOptions copy = options;
  TreeWriter writer;
  bind(writer, copy);
  return writer.tree();
}

}  // namespace uncertainty_identification
