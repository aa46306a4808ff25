// Results and explanations that are well-formed JSON but do not hold together, as a bad disk or
// another program may leave them: each is read or refused, and what is read can be used.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "detection/fault_detector.h"
#include "io/explanation_text.h"
#include "io/report.h"
#include "io/result_text.h"
#include "support/error_message.h"
#include "support/example_explanation.h"
#include "uncertainty_identification/bounds/bounds.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/explanation_json.h"
#include "uncertainty_identification/io/result_json.h"
#include "uncertainty_identification/io/samples_json.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using nlohmann::json;

/// Two components of dimension two, so that every list has a length of its own.
Estimate estimateToMutate() {
  Estimate estimate = test::plainEstimate(Eigen::Vector2d(1, 0.5), Eigen::Vector3d(-0.5, 0.1, 0));
  estimate.error_model.options.taps = 3;
  estimate.error_model.T = ErrorBasis(estimate.error_model.options).T();
  const MatrixXd covariance = (MatrixXd(2, 2) << 0.2, 0.05, 0.05, 0.1).finished();
  estimate.error_model.mixture = {
      {0.25, 0.75}, {Eigen::Vector2d(-1, 0), Eigen::Vector2d(1, 0.5)}, {covariance, covariance}};
  estimate.joint_covariance = 1e-6 * MatrixXd::Identity(16, 16);
  estimate.nominal_model.c = VectorXd::Constant(1, 0.3);
  estimate.nominal_model.d = VectorXd::Constant(1, -0.4);
  estimate.experiment_count = 20;
  estimate.experiments = {{"run1", 100, {0.5, 0.5}, Eigen::Vector2d(0.1, 0.2), -3.5}};
  return estimate;
}

/// The same plant, two of whose parameters vary.
Estimate estimateThatVaries() {
  Estimate estimate = estimateToMutate();
  NominalModelOptions& form = estimate.configuration.nominal_model;
  form.orders_auto = false;
  form.nb = 2;
  form.na = 3;
  ErrorModelOptions& options = estimate.error_model.options;
  options.basis = BasisKind::parameter_spread;
  options.constraint = Constraint::zero_mean;
  options.taps = 2;
  options.parameters = {"b1", "b2"};
  estimate.error_model.T = MatrixXd::Identity(2, 2);
  estimate.error_model.mixture.means = {Eigen::Vector2d(-0.3, 0), Eigen::Vector2d(0.1, 0)};
  const std::vector<std::string> names{"b1", "b2", "a1", "a2", "a3", "c1", "d1"};
  const std::vector<double> values{1, 0.5, -0.5, 0.1, 0, 0.3, -0.4};
  for (std::size_t k = 0; k < names.size(); ++k)
    estimate.nominal_model.parameters.push_back({names[k], "", values[k], 0.1, 0.1});
  estimate.joint_covariance = MatrixXd();
  return estimate;
}

json treeOf(const Estimate& estimate) { return toJson(estimate); }

std::string refusalOf(const std::string& pointer, const json& value) {
  json tree = treeOf(estimateToMutate());
  tree[json::json_pointer(pointer)] = value;
  return messageOf<ConfigurationError>([&] { estimateFromJson(tree); });
}

bool startsWith(const std::string& text, const std::string& part) {
  return text.compare(0, part.size(), part) == 0;
}

TEST(ResultMutations, TheResultItselfIsRead) {
  const json tree = treeOf(estimateToMutate());
  EXPECT_EQ(treeOf(estimateFromJson(tree)), tree);
}

TEST(ResultMutations, RefusalsNameTheKey) {
  const std::vector<std::pair<std::string, json>> wrong{
      {"/error_model/weights", {0.3, 0.3, 0.4}},
      {"/error_model/weights", json::array()},
      {"/error_model/weights", {0.3, 0.3}},
      {"/error_model/weights", {-0.5, 1.5}},
      {"/error_model/means", json::array()},
      {"/error_model/means", {{1}, {1, 2}}},
      {"/error_model/means", {{1, nullptr}, {1, 2}}},
      {"/error_model/covariances", {{{-1, 0}, {0, 1}}, {{1, 0}, {0, 1}}}},
      {"/error_model/covariances", {{{1, 0.5}, {0, 1}}, {{1, 0}, {0, 1}}}},
      {"/error_model/covariances", {{{1}}, {{1}}}},
      {"/error_model/T", {{1, 0}, {0, 1}}},
      {"/error_model/T", {{1}, {0}, {1}}},
      {"/error_model/taps", 2147483647},
      {"/nominal_model/sample_time", -0.1},
      {"/nominal_model/delay", -1},
      {"/nominal_model/delay", 2000000000},
      {"/nominal_model/b", {1, nullptr}},
      {"/nominal_model/c", json::array({1.5})},
      {"/nominal_model/d", json::array({-2})},
      {"/nominal_model/covariance", {{1, 0}, {0, 1}}},
      {"/joint_covariance", {{1, 2}}},
      {"/joint_covariance", {{1, 0}, {0, -1}}},
      {"/joint_covariance", {{1, 2}, {3, 20}}},
      {"/experiments/count", -1},
      {"/experiments/estimates/0/responsibilities", {1, 0, 0}},
      {"/experiments/estimates/0/error_mean", json::array({1})},
      {"/validation/experiments", json::array({"v1"})}};
  for (const auto& [pointer, value] : wrong) {
    const std::string refusal = refusalOf(pointer, value);
    const std::string group = pointer.substr(1, pointer.find('/', 1) - 1);
    EXPECT_TRUE(startsWith(refusal, group)) << pointer << " " << value << ": " << refusal;
  }
}

TEST(ResultMutations, AComponentWithoutExperimentsMayHaveNoWeight) {
  EXPECT_EQ(refusalOf("/error_model/weights", {0, 1}), "no exception");
}

TEST(ResultMutations, NumbersBeyond64BitsAreRefused) {
  for (const json& number : {json(18446744073709551615u), json(-9223372036854775807 - 1)}) {
    const std::string refusal = refusalOf("/nominal_model/delay", number);
    EXPECT_TRUE(startsWith(refusal, "nominal_model.delay: found")) << refusal;
  }
}

json mutated(const json& value, std::mt19937_64* random) {
  json lists = value;
  if (value.is_array() && !value.empty()) lists.push_back(value[0]);
  const std::vector<json> others{nullptr,
                                 json::array(),
                                 json::object(),
                                 "text",
                                 -1,
                                 0,
                                 1e300,
                                 2147483647,
                                 18446744073709551615u,
                                 true,
                                 -0.25,
                                 lists,
                                 value.is_number() ? json(-value.get<double>()) : lists};
  return others[(*random)() % others.size()];
}

/// Changes, removes or adds one value at a random place of the tree.
void mutate(json* tree, std::mt19937_64* random) {
  json* at = tree;
  while (at->is_structured() && !at->empty()) {
    auto child = at->begin();
    std::advance(child, (*random)() % at->size());
    const auto choice = (*random)() % 8;
    if (choice == 0) {
      at->erase(child);
      return;
    }
    at = &*child;
    if (choice == 1) break;
  }
  *at = mutated(*at, random);
}

/// Where the parts lie that programs compute with: others are copied only.
json* partThatIsUsed(json* tree, std::mt19937_64* random) {
  static const std::vector<std::string> kParts{"error_model", "nominal_model", "joint_covariance",
                                               "noise_variance", "experiments"};
  const auto part = (*random)() % (2 * kParts.size());
  return part < kParts.size() ? &(*tree)[kParts[part]] : tree;
}

void use(const Estimate& estimate) {
  EXPECT_FALSE(resultText(estimate).empty());
  EXPECT_FALSE(
      reportHtml({estimate, {}, {}}, nullptr, {"{{result}}", "", "", "", "", "chart", ""}).empty());
  try {
    const PlantDistribution plants(estimate);
    for (const auto which : {Uncertainty::mixture, Uncertainty::total})
      toJson(plants.draw(20, which, 1), Eigen::Vector2d(0.1, 1));
  } catch (const Error&) {
  }
  try {
    FaultDetectionOptions options;
    options.window = 20;
    FaultDetector detector(estimate, options);
    for (int t = 0; t < 40; ++t) detector.add(t % 3, t % 5);
  } catch (const Error&) {
  }
}

TEST(ResultMutations, EachIsReadAndUsableOrRefused) {
  std::mt19937_64 random(20240917);
  const std::vector<json> wholes{treeOf(estimateToMutate()), treeOf(estimateThatVaries())};
  int read = 0, refused = 0;
  for (std::size_t k = 0; k < 800; ++k) {
    const json& whole = wholes[k % 2];
    json tree = whole;
    json* part = partThatIsUsed(&tree, &random);
    mutate(part, &random);
    SCOPED_TRACE(json::diff(whole, tree).dump());
    try {
      use(estimateFromJson(tree));
      ++read;
    } catch (const ConfigurationError&) {
      ++refused;
    }
  }
  EXPECT_GT(read, 50);
  EXPECT_GT(refused, 200);
}

/// What the reader cannot know, because it depends on the nominal model, its users refuse.
TEST(ResultMutations, UsersRefuseWhatTheyCannotComputeWith) {
  const auto refusal = [](const Estimate& estimate) {
    return messageOf<DataError>([&] { FaultDetector(estimate, FaultDetectionOptions()); });
  };
  Estimate late = estimateToMutate(), unstable = late, unmatched = estimateThatVaries();
  late.nominal_model.delay = 50000;
  EXPECT_TRUE(startsWith(refusal(late), "nominal_model.delay: ")) << refusal(late);
  unstable.nominal_model.a[0] = -2;
  EXPECT_TRUE(startsWith(refusal(unstable), "nominal_model.a: ")) << refusal(unstable);
  unmatched.error_model.options.parameters = {"b1"};
  const std::string key = "error_model.varied_parameters: found 1";
  EXPECT_TRUE(startsWith(refusal(unmatched), key)) << refusal(unmatched);
  const std::string drawn = messageOf<DataError>([&] { PlantDistribution plants(unmatched); });
  EXPECT_TRUE(startsWith(drawn, key)) << drawn;
  const std::string none = messageOf<DataError>([] { PlantDistribution plants{Estimate()}; });
  EXPECT_TRUE(startsWith(none, "the result holds no model")) << none;
}

TEST(ResultMutations, EachExplanationIsReadAndPrintedOrRefused) {
  std::mt19937_64 random(20240918);
  json whole = toJson(test::exampleExplanation());
  int read = 0, refused = 0;
  for (int k = 0; k < 400; ++k) {
    json tree = whole;
    mutate(k % 2 == 0 ? &tree["causes"] : &tree, &random);
    SCOPED_TRACE(json::diff(whole, tree).dump());
    try {
      const Explanation explanation = explanationFromJson(tree);
      EXPECT_FALSE(explanationText(explanation).empty());
      ++read;
    } catch (const ConfigurationError&) {
      ++refused;
    }
  }
  EXPECT_GT(read, 20);
  EXPECT_GT(refused, 100);
}

TEST(ResultMutations, CurvesAndPicturesNeedAValueForEachPoint) {
  for (const char* pointer :
       {"/causes/0/simulation/curve/value", "/simulation/causes/0/curve/lower_90",
        "/simulation/pictures/0/before", "/pictures/0/simulated_after"}) {
    json tree = toJson(test::exampleExplanation());
    tree[json::json_pointer(pointer)] = json::array({1});
    const std::string refusal = messageOf<ConfigurationError>([&] { explanationFromJson(tree); });
    EXPECT_NE(refusal.find("found 1 entries; allowed: "), std::string::npos) << refusal;
  }
}

}  // namespace
}  // namespace uncertainty_identification
