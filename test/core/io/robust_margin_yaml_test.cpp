#include "io/robust_margin_yaml.h"

#include <gtest/gtest.h>

#include "io/tree_writer.h"
#include "support/error_message.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;

const std::string kMarginFile = std::string(PROJECT_FOLDER) + "/config/robust_margin.yaml";

std::string marginComplaint(const std::string& yaml) {
  return messageOf<ConfigurationError>([&] { parseRobustMargin(YAML::Load(yaml)); });
}

TEST(RobustMarginYaml, TheShippedFileStatesTheDefaultsOfAllButTheController) {
  json found = writtenTree(loadRobustMargin(kMarginFile)),
       expected = writtenTree(RobustMarginOptions{});
  EXPECT_EQ(found["controller"], json({{"num", {0.1}}, {"den", {1.0, -1.0}}}));
  found.erase("controller");
  expected.erase("controller");
  EXPECT_EQ(found, expected);
  const YAML::Node file = YAML::LoadFile(kMarginFile);
  const json all = writtenTree(RobustMarginOptions{});
  for (const auto& [key, value] : all.items()) EXPECT_TRUE(file[key]) << key << " is not explained";
}

TEST(RobustMarginYaml, ValuesArrive) {
  const auto found = parseRobustMargin(YAML::Load(
      "{controller: {num: [1, 2], den: [4, 1]}, minimum_margin: 1.5, samples: 500, seed: 7}"));
  EXPECT_EQ(found.controller.num, Eigen::Vector2d(1, 2));
  EXPECT_EQ(found.controller.den, Eigen::Vector2d(4, 1));
  EXPECT_EQ(found.minimum_margin, 1.5);
  EXPECT_EQ(found.samples, 500);
  EXPECT_EQ(found.seed, 7u);
}

TEST(RobustMarginYaml, BadKeysAreNamed) {
  EXPECT_NE(marginComplaint("{}").find("controller.num: needs"), std::string::npos);
  EXPECT_EQ(marginComplaint("controller: {nmu: [1]}"),
            "controller.nmu (line 1): unknown key; did you mean controller.num?");
  EXPECT_NE(
      marginComplaint("controller: {num: [1], den: [1, -1.2]}").find("a pole of magnitude 1.2"),
      std::string::npos);
  EXPECT_EQ(marginComplaint("{controller: {num: [1], den: [1]}, samples: 5}"),
            "samples: found 5; allowed: 100 to 1000000");
}

}  // namespace
}  // namespace uncertainty_identification
