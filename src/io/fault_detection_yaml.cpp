#include "io/fault_detection_yaml.h"

#include "io/configuration_binding.h"
#include "io/tree_reader.h"
#include "io/untrusted_yaml.h"

namespace uncertainty_identification {

void bind(Archive& archive, FaultDetectionConfiguration& configuration) {
  FaultDetectionOptions& detection = configuration.detection;
  archive("window", detection.window);
  archive("false_alarm_rate", detection.false_alarm_rate);
  archive("initial_state", detection.initial_state);
  archive("discard_samples", orAutomatic(detection.discard_samples, kAutomatic));
  archive("parameter_uncertainty", detection.parameter_uncertainty);
  bindSignal(archive, "input", configuration.input);
  bindSignal(archive, "output", configuration.output);
  archive.section("experiment", [&configuration](Archive& section) {
    section("topic", configuration.experiment_topic);
  });
  archive("resampling", configuration.resampling);
}

FaultDetectionConfiguration parseFaultDetection(const YAML::Node& node) {
  return readYamlConfiguration<FaultDetectionConfiguration>(node);
}

FaultDetectionConfiguration loadFaultDetection(const std::string& path) {
  return loadYamlAs(path, parseFaultDetection);
}

}  // namespace uncertainty_identification
