#include "ros/parameters.h"

#include <gtest/gtest.h>

#include <ctime>

#include "support/error_message.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/configuration_yaml.h"

namespace uncertainty_identification {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue minimal() {
  XmlRpcValue parameters;
  parameters["nominal_model"]["orders"] = "auto";
  return parameters;
}

TEST(Parameters, EveryKindOfValueArrives) {
  XmlRpcValue parameters = minimal();
  parameters["sample_time"] = 0.1;
  parameters["nominal_model"]["max_order"] = 5;
  parameters["nominal_model"]["dead_time"] = true;
  parameters["input"]["topic"] = "cmd_vel";
  parameters["input"]["field"] = "linear.x";
  parameters["covariates"][0]["name"] = "temp";
  parameters["covariates"][0]["topic"] = "covariate/temp";
  parameters["error_model"]["constraint"] = "explicit";
  parameters["error_model"]["T"][0][0] = 1;
  parameters["error_model"]["T"][1][0] = -0.5;
  const Configuration configuration = parseParameters(parameters);
  EXPECT_EQ(configuration.sample_time, 0.1);
  EXPECT_TRUE(configuration.nominal_model.orders_auto);
  EXPECT_EQ(configuration.nominal_model.max_order, 5);
  EXPECT_TRUE(configuration.nominal_model.dead_time);
  EXPECT_EQ(configuration.input.field, "linear.x");
  ASSERT_EQ(configuration.covariates.size(), 1U);
  EXPECT_EQ(configuration.covariates[0].name, "temp");
  EXPECT_EQ(configuration.error_model.T(1, 0), -0.5);
}

TEST(Parameters, NoNodeStartsASimulationOfTheUser) {
  XmlRpcValue parameters = minimal();
  parameters["simulation"]["command"][0] = "./my_sim";
  EXPECT_NE(messageOf<ConfigurationError>([&] { parseParameters(parameters); })
                .find("simulation: a node starts no program of the user, but compares what one "
                      "publishes; give topic"),
            std::string::npos);
}

TEST(Parameters, ASimulationThatIsPublishedIsCompared) {
  XmlRpcValue parameters = minimal();
  parameters["simulation"]["topic"] = "sim/measurement";
  EXPECT_EQ(parseParameters(parameters).simulation->topic, "sim/measurement");
  parameters["experiment"]["mode"] = "message";
  EXPECT_NE(messageOf<ConfigurationError>([&] { parseParameters(parameters); }).find("give column"),
            std::string::npos);
  XmlRpcValue whole = minimal();
  whole["experiment"]["mode"] = "message";
  whole["simulation"]["column"] = "y_sim";
  EXPECT_EQ(parseParameters(whole).simulation->column, "y_sim");
}

TEST(Parameters, NumbersMayBeTextAsRosparamReadsThem) {
  XmlRpcValue parameters = minimal();
  parameters["estimation"]["tolerance"] = "1e-6";
  EXPECT_EQ(parseParameters(parameters).estimation.tolerance, 1e-6);
}

TEST(Parameters, NumbersKeepEveryBit) {
  XmlRpcValue parameters = minimal();
  parameters["sample_time"] = 1.0 / 3;
  EXPECT_EQ(parseParameters(parameters).sample_time, 1.0 / 3);
}

TEST(Parameters, UnknownKeyNamesTheNearest) {
  XmlRpcValue parameters = minimal();
  parameters["estimation"]["tolerence"] = 0.1;
  const auto message = messageOf<ConfigurationError>([&] { parseParameters(parameters); });
  EXPECT_NE(message.find("estimation.tolerence: unknown key; did you mean estimation.tolerance?"),
            std::string::npos)
      << message;
}

TEST(Parameters, WrongTypesAreNamed) {
  XmlRpcValue parameters = minimal();
  parameters["limits"]["max_experiments"] = "many";
  EXPECT_NE(messageOf<ConfigurationError>([&] {
              parseParameters(parameters);
            }).find("limits.max_experiments: found 'many'"),
            std::string::npos);
  parameters = minimal();
  std::tm date{};
  parameters["sample_time"] = XmlRpcValue(&date);
  EXPECT_NE(messageOf<ConfigurationError>([&] {
              parseParameters(parameters);
            }).find("sample_time: found a binary value, a date"),
            std::string::npos);
}

TEST(Parameters, KeysOfRosLibrariesAreAllowed) {
  XmlRpcValue parameters = minimal();
  parameters["diagnostic_period"] = 2.0;
  parameters["identify_bags"]["status_frequency"] = 1.0;
  parameters["actionlib_server_pub_queue_size"] = 5;
  EXPECT_NO_THROW(parseParameters(parameters));
}

TEST(Parameters, ShippedConfigurationsLoad) {
  const std::string folder = std::string(PROJECT_FOLDER) + "/config/";
  EXPECT_TRUE(loadConfiguration(folder + "identification.yaml").nominal_model.orders_auto);
  EXPECT_EQ(loadConfiguration(folder + "replay.yaml").experiment.duration, 10);
}

}  // namespace
}  // namespace uncertainty_identification
