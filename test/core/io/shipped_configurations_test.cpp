// Every file of config/ is a configuration or a truth that its reader accepts.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/fault_detection_yaml.h"
#include "io/robust_margin_yaml.h"
#include "io/truth_yaml.h"
#include "uncertainty_identification/io/configuration_yaml.h"

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;

TEST(ShippedConfigurations, AllAreAccepted) {
  int loaded = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(std::string(PROJECT_FOLDER) + "/config")) {
    if (!entry.is_regular_file()) continue;
    const std::string path = entry.path().string();
    ASSERT_EQ(entry.path().extension(), ".yaml") << path;
    const std::string name = entry.path().stem().string();
    if (name == "fault_detection") {
      EXPECT_NO_THROW(loadFaultDetection(path)) << path;
    } else if (name == "robust_margin") {
      EXPECT_NO_THROW(loadRobustMargin(path)) << path;
    } else if (name.find("truth") != std::string::npos) {
      EXPECT_NO_THROW(loadTruth(path).validate()) << path;
    } else {
      EXPECT_NO_THROW(loadConfiguration(path).validate()) << path;
    }
    ++loaded;
  }
  EXPECT_GE(loaded, 6);
}

}  // namespace
}  // namespace uncertainty_identification
