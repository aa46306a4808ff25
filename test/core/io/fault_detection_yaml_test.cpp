#include "io/fault_detection_yaml.h"

#include <gtest/gtest.h>

#include "io/tree.h"
#include "io/tree_writer.h"
#include "io/untrusted_yaml.h"
#include "support/error_message.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;

const std::string kFile = std::string(PROJECT_FOLDER) + "/config/fault_detection.yaml";

std::string faultComplaint(const std::string& yaml) {
  return messageOf<ConfigurationError>([&] { parseFaultDetection(YAML::Load(yaml)); });
}

/// All paths of a tree's keys.
std::string keys(const json& tree, const std::string& parent = "") {
  std::string all;
  if (!tree.is_object()) return parent + "\n";
  for (const auto& [key, value] : tree.items()) all += keys(value, pathOf(parent, key));
  return all;
}

TEST(FaultDetectionYaml, TheShippedFileStatesEveryKeyAndItsDefault) {
  EXPECT_EQ(keys(*treeFromYaml(loadYaml(kFile)).value),
            keys(writtenTree(FaultDetectionConfiguration{})));
  EXPECT_EQ(writtenTree(loadFaultDetection(kFile)), writtenTree(FaultDetectionConfiguration{}));
}

TEST(FaultDetectionYaml, ValuesArrive) {
  const auto found = parseFaultDetection(YAML::Load(
      "{window: 20, false_alarm_rate: 1.0e-3, initial_state: discard, discard_samples: 7, "
      "parameter_uncertainty: false, input: {topic: cmd_vel, field: linear.x, scale: deg}, "
      "experiment: {topic: "
      "active}, resampling: {output: mean}}"));
  EXPECT_EQ(found.detection.window, 20);
  EXPECT_EQ(found.detection.false_alarm_rate, 1e-3);
  EXPECT_EQ(found.detection.initial_state, InitialState::discard);
  EXPECT_EQ(found.detection.discard_samples, 7);
  EXPECT_FALSE(found.detection.parameter_uncertainty);
  EXPECT_EQ(found.input.field, "linear.x");
  EXPECT_NEAR(found.input.scale, 0.0174532925199433, 1e-15);
  EXPECT_EQ(found.experiment_topic, "active");
  EXPECT_EQ(found.resampling.output, OutputResampling::mean);
}

TEST(FaultDetectionYaml, BadKeysAreNamed) {
  EXPECT_EQ(faultComplaint("windwo: 20"), "windwo (line 1): unknown key; did you mean window?");
  EXPECT_EQ(faultComplaint("experiment: {tpoic: x}"),
            "experiment.tpoic (line 1): unknown key; did you mean experiment.topic?");
  EXPECT_EQ(faultComplaint("window: 3"), "window: found 3; allowed: 10 to 100000");
  EXPECT_EQ(faultComplaint("input: {topic: ''}"), "input.topic: found ''; allowed: a topic");
  EXPECT_NE(faultComplaint("false_alarm_rate: often").find("found 'often'"), std::string::npos);
}

}  // namespace
}  // namespace uncertainty_identification
