// The section `simulation` of a configuration, and what it opens.
#include "io/open_simulation.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/own_simulation_text.h"
#include "support/error_message.h"
#include "support/example_explanation.h"
#include "support/plain_estimate.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/configuration_yaml.h"
#include "uncertainty_identification/io/explanation_json.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {
namespace {

Configuration configured(const std::string& yaml) {
  return parseConfiguration(YAML::Load("simulation: " + yaml));
}

std::string simulationRefusal(const std::string& yaml) {
  return messageOf<ConfigurationError>([&] { configured(yaml); });
}

std::unique_ptr<Simulation> opened(const std::string& yaml) {
  return openSimulation(*configured(yaml).simulation, 0.1);
}

TEST(OpenSimulation, ReadsEachWayAndWritesItAgain) {
  for (const char* yaml :
       {"{model: {num: [1, 2], den: [1, 3, 4], dead_time: 0.2}}", "{model: {gain: 1, tau1: 0.1}}",
        "{model: {domain: z, zeros: [0.5], poles: [0.9, 0.2+0.1j, 0.2-0.1j], gain: 3}}",
        "{command: [./my_sim, --fast], parameters: {mass: {value: 1.2, unit: kg}}, time_limit: 3}",
        "{fmu: m.fmu, input: u, output: y, parameters: {mass: {value: 1.2}}, memory_limit: 50}",
        "{column: y_sim}", "{topic: sim/measurement, field: data}",
        "{result: earlier_result.json, max_simulations: 500}"}) {
    const Configuration once = configured(yaml);
    ASSERT_TRUE(once.simulation.has_value()) << yaml;
    EXPECT_EQ(toJson(configurationFromJson(toJson(once))), toJson(once)) << yaml;
  }
  EXPECT_EQ(configured("{command: [a, b], parameters: {mass: {value: 1.2, unit: kg}}}")
                .simulation->parameters.at("mass")
                .value,
            1.2);
  const auto listed =
      configured("{fmu: m.fmu, input: u, output: y, parameters: [mass, friction]}").simulation;
  EXPECT_EQ(listed->parameters.size(), 2u);
  EXPECT_TRUE(std::isnan(listed->parameters.at("friction").value)) << "that of the FMU";
  EXPECT_FALSE(toJson(Configuration{}).contains("simulation"))
      << "results without one stay as they are";
}

TEST(OpenSimulation, RefusesWhatIsNoSimulation) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"{colum: y_sim}", "simulation.colum (line 1): unknown key; did you mean simulation.column?"},
      {"{model: {tau: 1}}", "unknown key; did you mean simulation.model.tau1?"},
      {"{command: [a], parameters: {mass: {valu: 1}}}",
       "did you mean simulation.parameters.mass.value?"},
      {"{command: [a], parameters: {mass: {unit: kg}}}",
       "simulation.parameters.mass.value: found nan; allowed: the value that your simulation has"},
      {"{}", "simulation: found none of them; allowed: exactly one of model, result, command"},
      {"{column: y, result: r.json}", "simulation: found several of them"},
      {"{model: {}}", "simulation.model: found no form"},
      {"{model: {num: [1], den: [1, 1], tau1: 3}}", "simulation.model: found several forms"},
      {"{model: {num: [1]}}", "found num without den"},
      {"{model: {num: [1], den: [1, 1], gain: 2}}", "multiply num by it"},
      {"{model: {tau1: -1}}", "simulation.model.tau1: found -1; allowed: above 0"},
      {"{model: {tau1: 1, domain: z}}", "simulation.model.domain: found z"},
      {"{model: {num: [1], den: [1, 1], domain: w}}", "expected one of s, z"},
      {"{column: y, parameters: {mass: {value: 1}}}", "simulation.parameters: found parameters"},
      {"{command: ['']}", "simulation.command: found an empty text"},
      {"{column: y, max_simulations: 3}", "simulation.max_simulations: found 3; allowed: 10 to"},
      {"{column: y, time_limit: 0}", "simulation.time_limit: found 0"},
      {"{fmu: a.fmu, output: y}", "simulation.input: found ''; allowed: the variable of the FMU"},
      {"{fmu: a.fmu, input: u}", "simulation.output: found ''; allowed: the variable of the FMU"},
      {"{column: y, input: u}", "simulation.input: found 'u'; allowed: none without fmu"},
      {"{command: [a], parameters: [mass]}", "simulation.parameters.mass.value: found nan"},
      {"{command: [a], memory_limit: 1}", "simulation.memory_limit: found 1; allowed: 10 or above"},
      {"{fmu: a.fmu, input: u, output: y, steps_per_sample: 0}", "simulation.steps_per_sample"}};
  for (const auto& [yaml, message] : cases)
    EXPECT_NE(simulationRefusal(yaml).find(message), std::string::npos) << yaml << "\n"
                                                                        << simulationRefusal(yaml);
}

TEST(OpenSimulation, OpensModelsAndSignals) {
  const auto model = opened("{model: {num: [2], den: [0.4, 1]}}");
  EXPECT_EQ(model->parameters().at(1).name, "tau1");
  EXPECT_NEAR(model->parameters()[1].value, 0.4, 1e-12);
  EXPECT_EQ(model->description(), "the transfer function of simulation.model");
  const auto column = opened("{column: y_sim}");
  EXPECT_FALSE(column->canRerun());
  EXPECT_EQ(column->description(), "the column y_sim");
}

TEST(OpenSimulation, ALoggedSimulationIsASignalOfTheData) {
  const Configuration column = withLoggedSimulation(configured("{column: y_sim}"));
  ASSERT_EQ(column.covariates.size(), 1u);
  EXPECT_EQ(column.covariates[0].name, "y_sim");
  EXPECT_EQ(column.covariates[0].column, "") << "other columns stay covariates";
  EXPECT_EQ(withLoggedSimulation(column).covariates.size(), 1u);
  EXPECT_EQ(withLoggedSimulation(configured("{topic: sim/y, field: data}")).covariates[0].topic,
            "sim/y");
  EXPECT_TRUE(withLoggedSimulation(Configuration{}).covariates.empty());
  EXPECT_TRUE(withLoggedSimulation(configured("{model: {tau1: 1}}")).covariates.empty());
}

TEST(OpenSimulation, AnEarlierResultIsASimulation) {
  const TemporaryFolder folder;
  Result result;
  result.estimate = test::plainEstimate(Eigen::Vector2d(0.3, 0.2), Eigen::Vector2d(-0.9, 0.2));
  NominalModelEstimate& nominal = result.estimate.nominal_model;
  nominal.delay = 2;
  saveResult(folder / "r.json", result);
  const auto simulation = openSimulation(
      *configured("{result: " + (folder / "r.json") + "}").simulation, nominal.sample_time);
  Eigen::VectorXd values(static_cast<Eigen::Index>(simulation->parameters().size()));
  for (Eigen::Index k = 0; k < values.size(); ++k)
    values[k] = simulation->parameters()[static_cast<std::size_t>(k)].value;
  const Eigen::VectorXd y =
      simulation->run({nominal.sample_time, Eigen::VectorXd::Ones(8), {}, {}, {}}, values);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(8);
  for (Eigen::Index k = 2; k < 8; ++k)
    expected[k] = 0.9 * expected[k - 1] - 0.2 * expected[k - 2] + 0.3 + (k > 2 ? 0.2 : 0);
  EXPECT_LT((y - expected).norm(), 1e-9);
  EXPECT_THROW(opened("{result: " + (folder / "none.json") + "}"), FileError);
}

TEST(OpenSimulation, IsRefusedForOthersThanTheUser) {
  EXPECT_NO_THROW(refuseSimulation({}, "the node compares none"));
  EXPECT_EQ(
      messageOf<ConfigurationError>(
          [] { refuseSimulation(configured("{command: [rm]}"), "the node compares none"); }),
      "simulation: the node compares none; leave it out, and run the program explain with it");
}

OwnSimulationFindings exampleFindings() {
  OwnSimulationFindings found;
  found.simulation = "the program ./my_sim";
  found.can_rerun = true;
  found.sentence =
      "Your simulation fits 71.2 % of runs not used for fitting; with mass 9 % higher "
      "it fits 94.0 %";
  OwnCause cause;
  cause.name = "sim_parameter";
  cause.parameter = "mass";
  cause.description = "mass 9.1 +- 0.4 % higher";
  cause.remark = "looks like a factor";
  cause.advice = "set mass to 1.31 kg";
  cause.values = {{"mass", "kg", 1.2, 1.309, 0.005, 1.3, 1.32, 0.02}};
  cause.t = 22;
  cause.fit_without = 71.2;
  cause.ties = {"another length"};
  found.causes = {cause};
  found.fit_before = 71.2;
  found.fit_after = 94;
  found.held_out = {"run1"};
  found.runs = {{"median", "run1", 0.1, 0, Eigen::Vector2d(1, 2), Eigen::Vector2d(0.5, 1),
                 Eigen::Vector2d(1, 1.9), 70, 93}};
  found.extension.parameters = {{"mass", 1.309, "kg"}};
  found.extension.curve = OwnCurve{"input", {-1, 1}, {-2, 2}};
  found.extension.yours = SampledFilter{Eigen::Vector2d(0, 1), Eigen::Vector2d(1, -0.4)};
  found.extension.measured = SampledFilter{Eigen::Vector2d(0, 1), Eigen::Vector2d(1, -0.5)};
  found.structure.skipped = "not searched";
  found.simulations = 321;
  return found;
}

TEST(OwnSimulationText, BeginsWithTheAnswer) {
  const std::string text = ownSimulationText(exampleFindings());
  EXPECT_EQ(text.find("Your simulation fits 71.2 % of runs"), 0u) << text;
  for (const char* part :
       {"yours  measured", "mass [kg]", "1.3090 +- 0.0050", "1.3 to 1.32", "t = 22", "71.2 %",
        "sim_parameter (mass): mass 9.1 +- 0.4 % higher; looks like a factor",
        "or another length: the data cannot tell", "What to do: set mass to 1.31 kg",
        "This is the program ./my_sim, run 321 times"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(OwnSimulationText, TellsTheCurvesThatTheSimulationLacks) {
  OwnSimulationFindings found = exampleFindings();
  EXPECT_NE(ownSimulationText(found).find("About curves: not searched."), std::string::npos);
  found.structure = {};
  found.structure.causes = test::exampleExplanation().simulation.causes;
  found.structure.fit_before = 94;
  found.structure.fit_after = 98;
  const std::string text = ownSimulationText(found);
  EXPECT_LT(text.find("act_deadzone:"), text.find("Best without the curve  yours"));
  EXPECT_EQ(text.find("set mass to"), std::string::npos) << "it may only stand for the curve";
  for (const char* part :
       {"act_deadzone: the input acts through a dead zone\n  half_width 0.3100 +- 0.0040\n",
        "What to do: drive the actuator slowly", "mend the curve first, and compare again"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  found.has_curve_around = true;
  EXPECT_NE(ownSimulationText(found).find("set mass to"), std::string::npos);
  EXPECT_EQ(ownSimulationText(found).find("mend the curve first"), std::string::npos);
}

TEST(ExplanationJson, HoldsWhatIsWrongWithTheUsersSimulation) {
  Explanation explanation = test::exampleExplanation();
  EXPECT_FALSE(toJson(explanation).contains("own_simulation"));
  explanation.own_simulation = exampleFindings();
  const nlohmann::json tree = toJson(explanation);
  EXPECT_EQ(tree["own_simulation"]["causes"][0]["values"][0]["measured"], 1.309);
  EXPECT_EQ(tree["own_simulation"]["extension"]["measured"]["den"], nlohmann::json({1, -0.5}));
  EXPECT_EQ(tree["own_simulation"]["extension"]["curve"]["of"], "input");
  EXPECT_EQ(tree["own_simulation"]["runs"][0]["extended"], nlohmann::json({1, 1.9}));
  EXPECT_EQ(toJson(explanationFromJson(tree)), tree);
  nlohmann::json cut = tree;
  cut["own_simulation"]["causes"][0].erase("values");
  EXPECT_EQ(messageOf<ConfigurationError>([&] { explanationFromJson(cut); }),
            "own_simulation.causes[0].values: missing (is the file truncated?)");
  cut = tree;
  cut["own_simulation"]["runs"][0]["yours"] = {1};
  EXPECT_NE(messageOf<ConfigurationError>([&] {
              explanationFromJson(cut);
            }).find("own_simulation.runs.yours: found 1 entries"),
            std::string::npos);
}

}  // namespace
}  // namespace uncertainty_identification
