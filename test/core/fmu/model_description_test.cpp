// modelDescription.xml of both versions, and what is none.
#include "fmu/model_description.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fmu/unpacked_fmu.h"
#include "support/error_message.h"
#include "support/fmu_builder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

class ModelDescriptionTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!readsFmus()) GTEST_SKIP() << "built without libzip or tinyxml2";
  }

  static std::string refusal(const std::string& xml) {
    return messageOf<ConfigurationError>([&] { parseModelDescription(xml); });
  }
};

TEST_F(ModelDescriptionTest, HoldsTheVariablesOfBothVersions) {
  for (const char* interface : {"CO_SIMULATION_2", "MODEL_EXCHANGE_2", "CO_SIMULATION_3"}) {
    const ModelDescription motor = parseModelDescription(test::motorDescription(interface));
    EXPECT_EQ(motor.identifier, "motor");
    EXPECT_EQ(motor.token, "{motor}");
    EXPECT_EQ(motor.variables.size(), 6u);
    EXPECT_EQ(motor.states, 1);
    const FmuVariable& inertia = motor.variable("parameters", "inertia", "parameter");
    EXPECT_EQ(inertia.reference, 2u);
    EXPECT_EQ(inertia.unit, "kg m2") << "that of its type";
    EXPECT_EQ(inertia.start, 0.02);
    EXPECT_EQ(motor.variable("output", "speed", "output").unit, "rad/s");
    EXPECT_TRUE(std::isnan(motor.variable("output", "speed", "output").start));
  }
  EXPECT_EQ(parseModelDescription(test::motorDescription("MODEL_EXCHANGE_2")).kind,
            FmuKind::model_exchange_2);
  EXPECT_EQ(parseModelDescription(test::motorDescription("CO_SIMULATION_3")).kind,
            FmuKind::co_simulation_3);
}

TEST_F(ModelDescriptionTest, NamesThatItDoesNotHaveAreRefusedWithThoseThatItHas) {
  const ModelDescription motor = parseModelDescription(test::motorDescription("CO_SIMULATION_2"));
  const auto message = [&](const char* key, const char* name, const char* causality) {
    return messageOf<ConfigurationError>([&] { motor.variable(key, name, causality); });
  };
  EXPECT_EQ(message("simulation.input", "torque", "input"),
            "simulation.input: found 'torque'; allowed, by the FMU's modelDescription.xml: "
            "voltage");
  EXPECT_EQ(message("simulation.parameters", "mass", "parameter"),
            "simulation.parameters: found 'mass'; allowed, by the FMU's modelDescription.xml: "
            "inertia, constant, damping, friction");
  EXPECT_EQ(
      message("simulation.output", "voltage", "output"),
      "simulation.output: found 'voltage'; allowed, by the FMU's modelDescription.xml: speed");
  EXPECT_EQ(messageOf<ConfigurationError>(
                [] { ModelDescription().variable("simulation.input", "u", "input"); }),
            "simulation.input: found 'u'; the FMU has no real input");
}

TEST_F(ModelDescriptionTest, RefusesWhatItCannotRun) {
  EXPECT_NE(refusal("<fmiModelDescription").find("modelDescription.xml is no XML"),
            std::string::npos);
  EXPECT_NE(refusal("<html/>").find("the FMU is of FMI version ''"), std::string::npos);
  EXPECT_NE(refusal("<fmiModelDescription fmiVersion=\"1.0\"/>").find("version '1.0'; allowed: 2"),
            std::string::npos);
  EXPECT_NE(refusal("<fmiModelDescription fmiVersion=\"3.0\"><ModelExchange modelIdentifier=\"a\"/>"
                    "</fmiModelDescription>")
                .find("offers no co-simulation; export it again"),
            std::string::npos);
  EXPECT_NE(refusal("<fmiModelDescription fmiVersion=\"2.0\"><CoSimulation "
                    "modelIdentifier=\"../a\"/></fmiModelDescription>")
                .find("modelIdentifier is '../a'"),
            std::string::npos);
}

}  // namespace
}  // namespace uncertainty_identification
