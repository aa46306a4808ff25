#include "uncertainty_identification/io/explanation_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/read_file.h"
#include "support/error_message.h"
#include "support/example_explanation.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;
using test::exampleExplanation;

std::string complaint(const json& tree) {
  return messageOf<ConfigurationError>([&] { explanationFromJson(tree); });
}

TEST(ExplanationJson, HoldsTheFieldsOfTheFormat) {
  const json tree = toJson(exampleExplanation());
  EXPECT_EQ(tree["format"], "uncertainty_identification/explanation/2");
  EXPECT_EQ(tree["verdict"], "partly_explained");
  EXPECT_EQ(tree["checks_before"][0], json({{"name", "whiteness"},
                                            {"statistic", 812.5},
                                            {"p_value", 1e-40},
                                            {"passed", false},
                                            {"where", "0.5 to 2 rad/s"}}));
  EXPECT_EQ(tree["checks_after"][0]["where"], "8 to 9 rad/s");
  const json& cause = tree["causes"][0];
  EXPECT_EQ(cause["name"], "act_deadzone");
  EXPECT_EQ(cause["group"], "actuator");
  EXPECT_EQ(cause["confidence"], 0.98);
  EXPECT_EQ(cause["equivalent"], json({"act_backlash"}));
  EXPECT_EQ(cause["advice"], "move the actuator slowly through zero");
  EXPECT_EQ(cause["parameters"][0], json({{"name", "width"},
                                          {"value", 0.31},
                                          {"standard_error", 0.004},
                                          {"lower_90", 0.303},
                                          {"upper_90", 0.317},
                                          {"unit", "V"}}));
  const json& gain = cause["gain"];
  EXPECT_EQ(
      gain["held_out_log_density_per_experiment"],
      json(
          {{"value", 12.25}, {"standard_error", 1.0 / 3}, {"lower_90", 11.5}, {"upper_90", 13.0}}));
  EXPECT_EQ(gain["nrmse_fit_percent"], json({{"before", 81.2}, {"after", 88.9}}));
  EXPECT_EQ(gain["coverage_95"], json({{"before", 0.91}, {"after", 0.95}}));
  EXPECT_EQ(gain["noise_variance"], json({{"before", 0.13}, {"after", 0.1}}));
  EXPECT_EQ(tree["candidates"][0]["score"], 412.5);
  EXPECT_EQ(tree["candidates"][0]["held_out_gain"], 12.25);
  EXPECT_EQ(tree["warnings"][0], "only 12 experiments were kept out of the fit");
  EXPECT_EQ(tree["pictures"][0]["input"], json({1, -1}));
  EXPECT_EQ(tree["residuals_after"]["of_experiment"], json({1, 0.75}));
}

TEST(ExplanationJson, HoldsPlaceShapeAndCurveOfWhatTheSimulationShows) {
  const json tree = toJson(exampleExplanation());
  const json& zone = tree["causes"][0]["simulation"];
  EXPECT_EQ(zone["place"], "input");
  EXPECT_EQ(zone["shape"], "dead_zone");
  EXPECT_EQ(zone["values"][0],
            json({{"name", "half_width"}, {"value", 0.31}, {"standard_error", 0.004}}));
  EXPECT_EQ(zone["curve"]["signal"], json({-1, 0, 1}));
  EXPECT_EQ(zone["curve"]["upper_90"], json({-0.68, 0.01, 0.7}));
  EXPECT_EQ(
      zone["ties"][0],
      json({{"name", "act_backlash"}, {"place", "play"}, {"shape", "play"}, {"covariate", ""}}));
  EXPECT_TRUE(tree["causes"][1]["simulation"].is_null());
  EXPECT_EQ(tree["simulation"]["causes"][0], zone);
  EXPECT_EQ(tree["simulation"]["fit_after"], 89.5);
  EXPECT_EQ(tree["simulation"]["pictures"][0]["after"], json({0.5, 2}));
  EXPECT_TRUE(tree["simulation"]["pictures"][0]["measured"][1].is_null());
  const Explanation back = explanationFromJson(tree);
  EXPECT_EQ(back.simulation.preparation, "12 records, simulated in 24 windows");
  EXPECT_EQ(back.causes[0].simulation->what.shape, "dead_zone");
  EXPECT_FALSE(back.causes[1].simulation.has_value());
}

TEST(ExplanationJson, TheModelIsAResultWithItsEffects) {
  const Explanation example = exampleExplanation();
  const json tree = toJson(example);
  EXPECT_EQ(tree["model"], toJson(example.after));
  EXPECT_EQ(tree["model"]["effects"][0]["name"], "act_deadzone");
  EXPECT_EQ(tree["model_before"], toJson(example.before));
}

TEST(ExplanationJson, WhatIsNotThereIsNull) {
  const json tree = toJson(exampleExplanation());
  EXPECT_TRUE(tree["causes"][1]["gain"].is_null());
  EXPECT_TRUE(tree["causes"][0]["gain"]["bode_area"]["after"].is_null());
  EXPECT_TRUE(tree["pictures"][0]["measured"][1].is_null());
  const Explanation back = explanationFromJson(tree);
  EXPECT_FALSE(back.causes[1].gain.has_value());
  EXPECT_TRUE(std::isnan(back.causes[0].gain->bode_area.after));
  EXPECT_TRUE(std::isnan(back.pictures[0].measured[1]));
  EXPECT_TRUE(std::isnan(back.candidates[1].held_out_gain));
}

TEST(ExplanationJson, RoundTripThroughTextKeepsEveryBit) {
  const Explanation example = exampleExplanation();
  const json tree = toJson(example);
  const Explanation back = explanationFromJson(json::parse(tree.dump()));
  EXPECT_EQ(toJson(back), tree);
  EXPECT_EQ(back.verdict, Verdict::partly_explained);
  EXPECT_EQ(back.causes[0].gain->standard_error, 1.0 / 3);
  EXPECT_EQ(back.candidates[1].variant, "temp");
  EXPECT_EQ(back.after.nominal_model.b, example.after.nominal_model.b);
  EXPECT_EQ(back.after.effects[0].parameters[0].unit, "V");
  EXPECT_EQ(back.termination, Termination::converged);
  EXPECT_EQ(back.held_out, example.held_out);
}

TEST(ExplanationJson, AnExplanationThatWasNeverMadeRoundTrips) {
  const json tree = toJson(Explanation{});
  EXPECT_EQ(tree["verdict"], "none");
  EXPECT_EQ(tree["termination"], "not_run");
  EXPECT_EQ(toJson(explanationFromJson(tree)), tree);
}

TEST(ExplanationJson, NamesEveryMissingField) {
  const json tree = toJson(exampleExplanation());
  for (const auto& [key, value] : tree.items()) {
    json without = tree;
    without.erase(key);
    EXPECT_EQ(complaint(without), key + ": missing (is the file truncated?)");
  }
  json without = tree;
  without["causes"][1].erase("gain");
  EXPECT_EQ(complaint(without), "causes[1].gain: missing (is the file truncated?)");
}

TEST(ExplanationJson, RefusesWhatIsNoSuchExplanation) {
  json tree = toJson(exampleExplanation());
  tree["verdict"] = "guessed";
  EXPECT_EQ(complaint(tree),
            "verdict: found 'guessed'; expected one of none, explained, partly_explained, unknown");
  tree = toJson(exampleExplanation());
  tree["causes"][0]["gain"]["noise_variance"]["after"] = "small";
  EXPECT_EQ(complaint(tree),
            "causes[0].gain.noise_variance.after: found 'small'; expected a number");
  tree = toJson(exampleExplanation());
  tree["model"].erase("effects");
  EXPECT_EQ(complaint(tree), "model.effects: missing (is the file truncated?)");
  EXPECT_EQ(complaint(toJson(exampleExplanation().after)),
            "format: found 'uncertainty_identification/result/1'; expected "
            "'uncertainty_identification/explanation/2'");
}

TEST(ExplanationJson, FilesThatAreTornOrForeignAreRefused) {
  const TemporaryFolder folder;
  const std::string path = folder / "explanation.json";
  saveExplanation(path, exampleExplanation());
  EXPECT_EQ(toJson(loadExplanation(path)), toJson(exampleExplanation()));
  const std::string content = readFile(path);
  std::ofstream(path) << content.substr(0, content.size() / 2);
  EXPECT_EQ(messageOf<ConfigurationError>([&] {
              loadExplanation(path);
            }).rfind(path + ": not JSON, or truncated: ", 0),
            0u);
  std::ofstream(path) << "[1, 2]";
  EXPECT_EQ(messageOf<ConfigurationError>([&] { loadExplanation(path); }),
            path + ": the document: found a list; expected a group of keys");
  EXPECT_NE(messageOf<FileError>([&] { loadExplanation(folder / "none.json"); }).find("none.json"),
            std::string::npos);
}

TEST(ExplanationJson, WhatIsNotUtf8InAnIdDoesNotCostTheExplanation) {
  const TemporaryFolder folder;
  Explanation example = exampleExplanation();
  example.pictures[0].id = "run\xff";
  saveExplanation(folder / "e.json", example);
  EXPECT_EQ(loadExplanation(folder / "e.json").pictures[0].id, "run\xef\xbf\xbd");
}

}  // namespace
}  // namespace uncertainty_identification
