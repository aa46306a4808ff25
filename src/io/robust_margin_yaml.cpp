#include "io/robust_margin_yaml.h"

#include "io/tree_reader.h"
#include "io/untrusted_yaml.h"

namespace uncertainty_identification {

void bind(Archive& archive, RobustMarginOptions& options) {
  archive.section("controller", [&options](Archive& section) {
    section("num", options.controller.num);
    section("den", options.controller.den);
  });
  archive("minimum_margin", options.minimum_margin);
  archive("samples", options.samples);
  archive("seed", options.seed);
}

RobustMarginOptions parseRobustMargin(const YAML::Node& node) {
  return readYamlConfiguration<RobustMarginOptions>(node);
}

RobustMarginOptions loadRobustMargin(const std::string& path) {
  return loadYamlAs(path, parseRobustMargin);
}

}  // namespace uncertainty_identification
