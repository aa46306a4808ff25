#include "uncertainty_identification/io/result_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/json_file.h"
#include "io/read_file.h"
#include "support/core_setup.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/configuration_yaml.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using nlohmann::json;
using test::vectorOf;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// An estimate with every field filled, with numbers that need all their digits.
Estimate estimate() {
  Estimate full;
  full.configuration.sample_time = 0.1;
  full.configuration.estimation.seed = 18446744073709551615u;
  full.version = "0.1.0";
  full.data_fingerprint = "abc";
  full.experiment_count = 2;
  full.sample_count = 5000000000;
  full.rejected = {{"bad", "constant input; record one that changes"}};
  full.nominal_model = {
      "box_jenkins", 0.1, 2, vectorOf({1.0 / 3, 2}), vectorOf({0.5}), vectorOf({0.1}),
      vectorOf({}),  {},  {}};
  full.nominal_model.parameters = {{"b1", "V", 1.0 / 3, 1e-300, kNan},
                                   {"a1", "", 0.5, 5e-324, 0.25}};
  full.nominal_model.covariance = (Eigen::Matrix2d() << 1, 2, 2, 4.000000000000001).finished();
  full.configuration.error_model = paperErrorModel();
  full.error_model.options = full.configuration.error_model;
  full.error_model.options.components = 2;
  full.error_model.T = vectorOf({1, -1});
  full.error_model.mixture = {{0.25, 0.75},
                              {vectorOf({-1}), vectorOf({0.1 + 0.2})},
                              {Eigen::MatrixXd::Constant(1, 1, 0.2), Eigen::MatrixXd::Zero(1, 1)}};
  full.error_model.parameters = {{"weight1", "", 0.25, 0.1, 0.2}};
  full.noise_variance = {"noise_variance", "V^2", 0.1, 0.01, 0.02};
  full.offset_u = -1e-17;
  full.offset_y = 3;
  full.log_likelihood = -3092.5330585980146;
  full.bic = 1e22;
  full.termination = Termination::iteration_limit;
  full.message = "stopped";
  full.iterations = 7;
  full.passes = 9;
  full.seconds = 0.5;
  full.trace = {{1, 2, -5.5, StepSummary{0.5, 3, true, 0.25}}, {2, 4, -4.5}};
  full.experiments = {{"exp \"1\"", 100, {0.1, 0.9}, vectorOf({0.7}), -10.25}};
  full.candidates = {{"orders", "output_error nb=2 na=2 delay=1", 4, {}, 5.0, 93.5, true}};
  full.validation = {{"v1", "v2"}, {90.5, -3}, 85, -12};
  full.residual_tests = {150, {0.1, -0.2}, {1.0 / 3, 0.01}, 0.25, kNan};
  full.simulation_fit_percent = 87.25;
  full.structure_error = {vectorOf({0.5, 20}), vectorOf({1.0 / 3, 7})};
  full.warnings = {"a warning"};
  return full;
}

std::string complaintOn(const json& tree) {
  try {
    estimateFromJson(tree);
  } catch (const ConfigurationError& error) {
    return error.what();
  }
  return "";
}

TEST(ResultJson, HoldsTheFieldsOfTheFormat) {
  const json tree = toJson(estimate());
  for (const char* key :
       {"format",         "version",       "configuration", "seed",           "data_fingerprint",
        "experiments",    "nominal_model", "error_model",   "noise_variance", "offsets",
        "log_likelihood", "bic",           "termination",   "message",        "iterations",
        "passes",         "seconds",       "validation",    "candidates",     "bounds",
        "warnings",       "residual_tests"}) {
    EXPECT_TRUE(tree.contains(key)) << key;
  }
  EXPECT_EQ(tree["format"], "uncertainty_identification/result/1");
  EXPECT_EQ(tree["seed"], 18446744073709551615u);
  EXPECT_EQ(tree["experiments"]["count"], 2);
  EXPECT_EQ(tree["experiments"]["samples"], 5000000000);
  EXPECT_EQ(tree["experiments"]["rejected"][0]["id"], "bad");
  EXPECT_EQ(tree["nominal_model"]["delay"], 2);
  EXPECT_EQ(tree["nominal_model"]["b"], json({1.0 / 3, 2}));
  EXPECT_EQ(tree["nominal_model"]["d"], json::array());
  EXPECT_EQ(tree["nominal_model"]["parameters"][1]["name"], "a1");
  EXPECT_EQ(tree["nominal_model"]["covariance"][1], json({2, 4.000000000000001}));
  EXPECT_EQ(tree["error_model"]["basis"], "fir");
  EXPECT_EQ(tree["error_model"]["taps"], 2);
  EXPECT_EQ(tree["error_model"]["constraint"], "zero_static_gain");
  EXPECT_EQ(tree["error_model"]["T"], json({{1}, {-1}}));
  EXPECT_EQ(tree["error_model"]["weights"], json({0.25, 0.75}));
  EXPECT_EQ(tree["error_model"]["means"], json({{-1}, {0.1 + 0.2}}));
  EXPECT_EQ(tree["error_model"]["covariances"], json::parse("[[[0.2]], [[0]]]"));
  EXPECT_EQ(tree["noise_variance"]["standard_error"], 0.01);
  EXPECT_EQ(tree["offsets"], json({{"u", -1e-17}, {"y", 3}}));
  EXPECT_EQ(tree["log_likelihood"], -3092.5330585980146);
  EXPECT_EQ(tree["bic"], 1e22);
  EXPECT_EQ(tree["termination"], "iteration_limit");
  EXPECT_EQ(tree["message"], "stopped");
  EXPECT_EQ(tree["iterations"], 7);
  EXPECT_EQ(tree["passes"], 9);
  EXPECT_EQ(tree["seconds"], 0.5);
  EXPECT_EQ(tree["data_fingerprint"], "abc");
  EXPECT_EQ(tree["trace"][0]["step"],
            json({{"norm", 0.5}, {"gradient_norm", 3}, {"accepted", true}, {"seconds", 0.25}}));
  EXPECT_EQ(tree["trace"][1], json({{"iteration", 2}, {"passes", 4}, {"log_likelihood", -4.5}}));
  EXPECT_EQ(tree["experiments"]["estimates"][0]["responsibilities"], json({0.1, 0.9}));
  EXPECT_EQ(tree["validation"]["simulation_fit_percent_pooled"], 85);
  EXPECT_EQ(tree["candidates"][0]["chosen"], true);
  EXPECT_EQ(tree["configuration"], toJson(estimate().configuration));
}

TEST(ResultJson, NumbersThatAreNotFiniteAreNull) {
  const json tree = toJson(estimate());
  EXPECT_TRUE(tree["nominal_model"]["parameters"][0]["robust_standard_error"].is_null());
  EXPECT_TRUE(tree["candidates"][0]["log_likelihood"].is_null());
  const Estimate back = estimateFromJson(tree);
  EXPECT_TRUE(std::isnan(back.nominal_model.parameters[0].robust_standard_error));
}

TEST(ResultJson, RoundTripThroughTextKeepsEveryBit) {
  const json tree = toJson(estimate());
  const Estimate back = estimateFromJson(json::parse(tree.dump()));
  EXPECT_EQ(toJson(back), tree);
  EXPECT_EQ(back.nominal_model.b, estimate().nominal_model.b);
  EXPECT_EQ(back.nominal_model.parameters[1].standard_error, 5e-324);
  EXPECT_EQ(back.error_model.T, estimate().error_model.T);
  EXPECT_EQ(back.structure_error.relative, estimate().structure_error.relative);
  EXPECT_EQ(back.simulation_fit_percent, 87.25);
  EXPECT_EQ(back.error_model.options.T.size(), 0);
  EXPECT_EQ(back.error_model.options.components, 2);
  EXPECT_EQ(back.noise_variance.unit, "V^2");
  EXPECT_EQ(back.termination, Termination::iteration_limit);
  EXPECT_EQ(back.experiments[0].id, "exp \"1\"");
}

TEST(ResultJson, StepsOfTheTraceMayBeAbsentAsInOlderResults) {
  const Estimate back = estimateFromJson(toJson(estimate()));
  ASSERT_EQ(back.trace.size(), 2u);
  EXPECT_EQ(back.trace[0].step->norm, 0.5);
  EXPECT_TRUE(back.trace[0].step->accepted);
  EXPECT_FALSE(back.trace[1].step.has_value());
  EXPECT_FALSE(back.candidates[0].log_likelihood.has_value());
}

TEST(ResultJson, ExplicitMatrixSurvives) {
  Estimate full = estimate();
  full.error_model.options.constraint = Constraint::explicit_matrix;
  full.error_model.options.T = full.error_model.T;
  EXPECT_EQ(estimateFromJson(toJson(full)).error_model.options.T, full.error_model.T);
}

TEST(ResultJson, NamesOfVaryingParametersSurviveBesideTheEstimates) {
  Estimate full = estimate();
  ErrorModelOptions& options = full.error_model.options;
  options.basis = BasisKind::parameter_spread;
  options.constraint = Constraint::zero_mean;
  options.parameters = {"tau1", "gain"};
  const json tree = toJson(full);
  EXPECT_EQ(tree["error_model"]["varied_parameters"], json({"tau1", "gain"}));
  EXPECT_EQ(tree["error_model"]["parameters"][0]["name"], "weight1");
  const Estimate back = estimateFromJson(tree);
  EXPECT_EQ(back.error_model.options.parameters, options.parameters);
  EXPECT_EQ(back.error_model.options.basis, BasisKind::parameter_spread);
  EXPECT_EQ(back.error_model.options.constraint, Constraint::zero_mean);
  EXPECT_EQ(back.error_model.parameters.size(), 1u);
}

TEST(ResultJson, WithoutResidualTestsThereAreNoProbabilities) {
  Estimate without = estimate();
  without.residual_tests = {};
  const json tree = toJson(without);
  EXPECT_TRUE(tree["residual_tests"]["whiteness_p_value"].is_null());
  EXPECT_TRUE(tree["residual_tests"]["independence_p_value"].is_null());
  EXPECT_EQ(toJson(estimateFromJson(tree)), tree);
}

TEST(ResultJson, WithoutValidationThereIsNoFit) {
  Estimate full = estimate();
  full.validation = {};
  const json tree = toJson(full);
  EXPECT_TRUE(tree["validation"]["simulation_fit_percent_pooled"].is_null());
  EXPECT_EQ(estimateFromJson(tree).validation.simulation_fit_percent_pooled, 0);
}

TEST(ResultJson, DefaultEstimateRoundTrips) {
  const json tree = toJson(Estimate{});
  EXPECT_EQ(tree["termination"], "not_run");
  EXPECT_EQ(toJson(estimateFromJson(tree)), tree);
}

TEST(ResultJson, RefusesWhatIsNoSuchResult) {
  json tree = toJson(estimate());
  tree["format"] = "uncertainty_identification/result/2";
  EXPECT_EQ(complaintOn(tree),
            "format: found 'uncertainty_identification/result/2'; expected "
            "'uncertainty_identification/result/1'");
  EXPECT_EQ(complaintOn(json::object()), "format: missing (is the file truncated?)");
  EXPECT_EQ(complaintOn(json::array()), "the document: found a list; expected a group of keys");
  tree = toJson(estimate());
  tree["nominal_model"]["b"][1] = "two";
  EXPECT_EQ(complaintOn(tree), "nominal_model.b[1]: found 'two'; expected a number");
  tree = toJson(estimate());
  tree["termination"] = "done";
  EXPECT_NE(
      complaintOn(tree).find("not_run, converged, iteration_limit, stalled, cancelled, time_limit"),
      std::string::npos);
}

TEST(ResultJson, NamesEveryMissingField) {
  const json tree = toJson(estimate());
  for (const auto& [key, value] : tree.items()) {
    if (key == "bounds") continue;  // written, never read
    // Results of older versions lack these.
    if (key == "trust" || key == "variation" || key == "structure_error" ||
        key == "simulation_fit_percent")
      continue;
    json without = tree;
    without.erase(key);
    EXPECT_EQ(complaintOn(without), key + ": missing (is the file truncated?)");
  }
}

TEST(ResultJson, IgnoresWhatALaterVersionAdds) {
  json tree = toJson(estimate());
  tree["later"] = 1;
  tree["nominal_model"]["later"] = 1;
  EXPECT_EQ(complaintOn(tree), "");
}

TEST(ResultJson, OlderResultsHaveNoTestOfLinearity) {
  json tree = toJson(estimate());
  tree["residual_tests"].erase("linearity_p_value");
  tree["residual_tests"].erase("nonlinear_share");
  EXPECT_EQ(complaintOn(tree), "");
}

TEST(ResultJson, StructureErrorsThatDoNotFitTogetherAreRefused) {
  json tree = toJson(estimate());
  tree["structure_error"]["relative"].push_back(1);
  EXPECT_EQ(complaintOn(tree), "structure_error.relative: found 3 entries; allowed: 2");
  tree = toJson(estimate());
  tree["structure_error"]["omega"][0] = 30;
  EXPECT_NE(complaintOn(tree).find("do not ascend"), std::string::npos) << complaintOn(tree);
}

TEST(ResultJson, OlderConfigurationsTakeDefaults) {
  json tree = toJson(estimate());
  tree["configuration"].erase("limits");
  EXPECT_EQ(complaintOn(tree), "");
}

TEST(ResultJson, SavesWhatAReportShowsFirst) {
  const std::string path = testing::TempDir() + "result_json_overview_test.json";
  Result result{estimate(), {}};
  result.physical = {"First-order plant.", {{"gain", "", 8.25, 8, 8.5, 0.4}, {"damping", "", 1}}};
  result.runs = {{"run 1", "best", true, 97.5, 0.1, vectorOf({1.0 / 3, kNan}), vectorOf({2, 3})}};
  result.origin = {"2026-03-14 15:09", {"a.csv", "b.csv"}, {"v.csv"}};
  saveResult(path, result);
  const Result back = loadResult(path);
  EXPECT_EQ(back.physical.sentence, "First-order plant.");
  EXPECT_EQ(back.physical.numbers[0].upper, 8.5);
  EXPECT_EQ(back.physical.numbers[0].spread, 0.4);
  EXPECT_FALSE(back.physical.numbers[1].lower.has_value());
  EXPECT_EQ(back.runs[0].rank, "best");
  EXPECT_TRUE(back.runs[0].validation);
  EXPECT_EQ(back.runs[0].measured[0], 0.33333);
  EXPECT_TRUE(std::isnan(back.runs[0].measured[1]));
  EXPECT_EQ(back.origin.data, result.origin.data);
  EXPECT_EQ(back.origin.validation, result.origin.validation);
  EXPECT_EQ(back.origin.date, result.origin.date);
  EXPECT_EQ(toJson(back), toJson(result));

  json older = json::parse(readFile(path));
  for (const char* key : {"physical", "runs", "origin"}) older.erase(key);
  std::ofstream(path) << older;
  EXPECT_TRUE(loadResult(path).runs.empty() && loadResult(path).physical.numbers.empty());
  EXPECT_EQ(std::remove(path.c_str()), 0);
}

TEST(ResultJson, FilesHoldAListOfNumbersInOneLine) {
  const std::string path = testing::TempDir() + "result_json_lists_test.json";
  const json tree = {{"numbers", {1, -2.5, nullptr, 4e-9}},
                     {"rows", {{1, 2}, {3, 4}}},
                     {"words", {"1,\n 2]", "[ 3"}},
                     {"empty", json::array()},
                     {"one", 1},
                     {"groups", {{{"a", 1}}, {{"b", {7}}}}}};
  saveJson(path, tree);
  const std::string content = readFile(path);
  EXPECT_EQ(json::parse(content), tree);
  EXPECT_NE(content.find("\"numbers\": [1,-2.5,null,4e-09]"), std::string::npos) << content;
  EXPECT_NE(content.find("[1,2],\n  [3,4]\n"), std::string::npos) << content;
  EXPECT_EQ(std::remove(path.c_str()), 0);
}

TEST(ResultJson, SavesAndLoadsFiles) {
  const std::string path = testing::TempDir() + "result_json_test.json";
  saveResult(path, {estimate(), {}});
  EXPECT_EQ(toJson(loadResult(path).estimate), toJson(estimate()));
  EXPECT_FALSE(loadResult(path).bounds.has_value());

  const std::string content = readFile(path);
  std::ofstream(path) << content.substr(0, content.size() / 2);
  try {
    loadResult(path);
    FAIL();
  } catch (const ConfigurationError& error) {
    EXPECT_EQ(std::string(error.what()).rfind(path + ": not JSON, or truncated", 0), 0u)
        << error.what();
  }
  EXPECT_THROW(loadResult("/nowhere/result.json"), FileError);
  EXPECT_THROW(saveResult("/nowhere/result.json", {estimate(), {}}), FileError);
  EXPECT_EQ(std::remove(path.c_str()), 0);
}

TEST(ResultJson, IdsThatAreNotUtf8DoNotCostTheResult) {
  Estimate full = estimate();
  full.rejected = {{"caf\xe9", "reason"}};
  const std::string path = testing::TempDir() + "result_json_test_utf8.json";
  EXPECT_NO_THROW(saveResult(path, {full, {}}));
  EXPECT_NO_THROW(loadResult(path));
  EXPECT_EQ(std::remove(path.c_str()), 0);
}

}  // namespace
}  // namespace uncertainty_identification
