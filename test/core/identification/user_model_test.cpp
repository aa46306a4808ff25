// Identifier with a nominal model of the caller's own; examples/motor_model.cpp is one from outside
// the package.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "model/box_jenkins.h"
#include "support/error_message.h"
#include "support/example1.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

std::shared_ptr<const NominalModel> outputError(double) {
  NominalModelOptions options;
  options.structure = Structure::output_error;
  return makeBoxJenkins(options);
}

TEST(UserModel, TakesThePlaceOfTheConfiguredOne) {
  const std::vector<Experiment> experiments = example1Experiments(10);
  Configuration configuration = example1Configuration();
  configuration.error_model.components = 1;
  const Estimate own = Identifier(configuration, outputError).identify(experiments);
  configuration.nominal_model.structure = Structure::output_error;
  const Estimate configured = Identifier(configuration).identify(experiments);
  EXPECT_EQ(own.nominal_model.structure, "output_error");
  EXPECT_EQ(own.nominal_model.parameters.size(), 2u);
  EXPECT_EQ(own.log_likelihood, configured.log_likelihood);
  EXPECT_EQ(own.nominal_model.b, configured.nominal_model.b);
}

TEST(UserModel, IsKeptWhenReidentified) {
  Configuration configuration = example1Configuration();
  configuration.error_model.components = 1;
  const Identifier identifier(configuration, outputError);
  const Estimate first = identifier.identify(example1Experiments(10));
  const Estimate second = identifier.reidentify(first, example1Experiments(12));
  EXPECT_EQ(second.nominal_model.structure, "output_error");
  EXPECT_EQ(second.experiment_count, 12);
}

TEST(UserModel, LearnsTheSampleTimeOfTheData) {
  Configuration configuration = example1Configuration();
  configuration.error_model.components = 1;
  double sample_time = 0;
  const Identifier identifier(configuration, [&sample_time](double of_data) {
    sample_time = of_data;
    return outputError(of_data);
  });
  const std::vector<Experiment> experiments = example1Experiments(4);
  identifier.identify(experiments);
  EXPECT_EQ(sample_time, experiments.front().sample_time);
}

TEST(UserModel, WhatIsForBoxJenkinsModelsIsRefused) {
  const auto messageFor = [](const Configuration& configuration) {
    return messageOf<ConfigurationError>([&] { Identifier(configuration, outputError); });
  };
  Configuration configuration;
  EXPECT_FALSE(Identifier(configuration, outputError).configuration().nominal_model.orders_auto);
  configuration.nominal_model.fit = PlantFit::simulation;
  EXPECT_NE(messageFor(configuration).find("nominal_model.fit"), std::string::npos);
}

}  // namespace
}  // namespace uncertainty_identification
