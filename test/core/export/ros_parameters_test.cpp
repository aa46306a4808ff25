// The YAML file, read as `rosparam load` does.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "export/targets.h"
#include "support/export_setup.h"
#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

using test::exportedAs;
using test::WrittenFile;

/// What `rosparam load` would send to the parameter server, with the types of Python.
const char* const kReader = R"(
import json, sys
sys.path.append("/usr/lib/python3/dist-packages")
import rosparam
(parameters, namespace), = rosparam.load_file(sys.argv[1], default_namespace="/motor")
assert namespace == "/motor"
print(json.dumps(parameters))
)";

nlohmann::json loaded(const ExportedModel& model) {
  const WrittenFile file("motor.yaml", rosParameters(model));
  const ProcessResult run = test::python({"-c", kReader, file.path()});
  EXPECT_EQ(run.status, 0) << run.errors << rosParameters(model);
  return nlohmann::json::parse(run.output, nullptr, false);
}

Result resultWithPhysicalNumbers() {
  Result result = test::delayedResult();
  result.physical = {"Second-order plant.",
                     {{"gain", "", 2.5, 2.4, 2.6, 0.1},
                      {"time constant/1", "s", 1e-5, {}, std::nan(""), {}},
                      {"bandwidth", "rad/s", std::nan(""), {}, {}, {}}}};
  result.estimate.trust = {false, {"too \"few\" experiments", "noise"}};
  return result;
}

TEST(RosParameters, RosparamReadsTheModel) {
  const ExportedModel model = exportedAs("motor", test::delayedResult());
  const nlohmann::json read = loaded(model);
  EXPECT_EQ(read["sample_time"], 0.1);
  EXPECT_EQ(read["delay"], 4);
  EXPECT_TRUE(read["delay"].is_number_integer());
  EXPECT_EQ(read["num"], nlohmann::json::parse("[0.0, 0.0, 0.0, 0.0, 0.5, 0.3]"));
  EXPECT_EQ(read["den"], nlohmann::json::parse("[1.0, -1.2, 0.5, 0.0, 0.0, 0.0]"));
  EXPECT_EQ(read["offset_u"], -0.25);
  EXPECT_EQ(read["offset_y"], 3.5);
  EXPECT_EQ(read["noise"]["num"], nlohmann::json::parse("[1.0, 0.3, 0.0]"));
  EXPECT_EQ(read["noise"]["den"], nlohmann::json::parse("[1.0, -0.7, 0.2]"));
  EXPECT_EQ(read["noise"]["variance"], 0.1);
  EXPECT_EQ(read["weight"]["level"], 0.95);
  ASSERT_EQ(read["weight"]["num"].size(), static_cast<std::size_t>(model.weight->num.cols()));
  for (std::size_t k = 0; k < read["weight"]["num"].size(); ++k) {
    EXPECT_EQ(read["weight"]["num"][k], model.weight->num(0, static_cast<Eigen::Index>(k)));
    EXPECT_EQ(read["weight"]["den"][k], model.weight->den(0, static_cast<Eigen::Index>(k)));
  }
  EXPECT_EQ(read["uncertainty"]["trusted"], true);
  EXPECT_TRUE(read["uncertainty"]["reasons"].empty());
}

TEST(RosParameters, RosparamReadsTheSpread) {
  const nlohmann::json read = loaded(exportedAs("motor", resultWithPhysicalNumbers()));
  const nlohmann::json& uncertainty = read["uncertainty"];
  EXPECT_EQ(uncertainty["trusted"], false);
  EXPECT_EQ(uncertainty["reasons"], nlohmann::json::parse(R"(["too ?few? experiments", "noise"])"));
  EXPECT_EQ(uncertainty["physical"]["gain"],
            nlohmann::json::parse(
                R"({"value": 2.5, "lower_95": 2.4, "upper_95": 2.6, "spread": 0.1, "unit": ""})"));
  EXPECT_EQ(uncertainty["physical"]["time_constant_1"],
            nlohmann::json::parse(R"({"value": 1e-5, "unit": "s"})"));
  EXPECT_EQ(uncertainty["physical"].count("bandwidth"), 0u) << "not a number";
}

TEST(RosParameters, WhatIsMissingIsAbsentAndSaid) {
  const ExportedModel model = exportedAs("motor", test::bareResult());
  const nlohmann::json read = loaded(model);
  EXPECT_EQ(read["num"], nlohmann::json::parse("[2.5]"));
  EXPECT_EQ(read.count("weight"), 0u);
  EXPECT_EQ(read["uncertainty"].count("physical"), 0u);
  EXPECT_TRUE(test::mentions(rosParameters(model), "\n# Missing: bands and weight"));
}

TEST(RosParameters, SmallNumbersAreNoTexts) {
  const nlohmann::json read = loaded(exportedAs("motor", test::slowResult()));
  EXPECT_EQ(read["num"][1], 1e-9);
}

}  // namespace
}  // namespace uncertainty_identification
