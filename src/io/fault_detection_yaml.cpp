#include "io/fault_detection_yaml.h"

#include "io/configuration_binding.h"
#include "io/tree.h"
#include "io/tree_reader.h"
#include "io/tree_writer.h"

namespace uncertainty_identification {

template <class Archive>
void bind(Archive& archive, FaultDetectionConfiguration& configuration) {
  FaultDetectionOptions& detection = configuration.detection;
  archive("window", detection.window);
  archive("false_alarm_rate", detection.false_alarm_rate);
  archive("initial_state", detection.initial_state);
  archive("discard_samples", orAutomatic(detection.discard_samples, kAutomatic));
  archive("parameter_uncertainty", detection.parameter_uncertainty);
  const auto signal = [&archive](const char* key, SignalOptions& options) {
    archive.section(key, [&options](auto& section) {
      section("topic", options.topic);
      section("field", options.field);
    });
  };
  signal("input", configuration.input);
  signal("output", configuration.output);
  archive.section("experiment", [&configuration](auto& section) {
    section("topic", configuration.experiment_topic);
  });
  archive("resampling", configuration.resampling);
}

FaultDetectionConfiguration parseFaultDetection(const YAML::Node& node) {
  const Tree tree = treeFromYaml(node);
  FaultDetectionConfiguration configuration;
  TreeReader reader(tree.value, tree.lines, ReadingRule::configuration);
  bind(reader, configuration);
  reader.finish();
  configuration.validate();
  return configuration;
}

FaultDetectionConfiguration loadFaultDetection(const std::string& path) {
  return loadYamlAs(path, parseFaultDetection);
}

nlohmann::json toJson(const FaultDetectionConfiguration& configuration) {
  FaultDetectionConfiguration copy = configuration;
  TreeWriter writer;
  bind(writer, copy);
  return writer.tree();
}

}  // namespace uncertainty_identification
