#include "uncertainty_identification/io/configuration_yaml.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "configuration/edit_distance.h"
#include "io/tree.h"
#include "io/untrusted_yaml.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;

/// The message that parsing ends in; empty when it succeeds.
std::string complaint(const YAML::Node& node) {
  try {
    parseConfiguration(node);
  } catch (const ConfigurationError& error) {
    return error.what();
  }
  return "";
}

std::string complaint(const std::string& yaml) { return complaint(YAML::Load(yaml)); }

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Paths of all keys of a tree; lists and the free-form `fixed` are leaves.
std::set<std::string> paths(const json& tree, const std::string& parent = "") {
  std::set<std::string> all;
  for (const auto& [key, value] : tree.items()) {
    const std::string path = pathOf(parent, key);
    const bool group = value.is_object() && key != "fixed";
    if (group) all.merge(paths(value, path));
    if (!group) all.insert(path);
  }
  return all;
}

/// A YAML document with one key, given by its path, e.g. {nominal_model: {nb: <value>}}.
YAML::Node documentWith(const std::string& path, const YAML::Node& value) {
  YAML::Node document;
  const auto dot = path.find('.');
  if (dot == std::string::npos) {
    document[path] = value;
  } else {
    document[path.substr(0, dot)] = documentWith(path.substr(dot + 1), value);
  }
  return document;
}

/// A configuration with no value at its default.
Configuration unusual() {
  return parseConfiguration(YAML::Load(R"(
sample_time: 0.012345678901234567
nominal_model: {structure: output_error, orders: given, focus: prediction, fit: simulation, max_order: 5, max_delay: 7, nb: 3, na: 4, nc: 2,
                nd: 0, delay: 6, time_constants: 2, resonances: 1, zeros: 2, dead_time: true, feedthrough: true,
                center: [1, 2], directions: [[1, 0], [0.5, 1]], fixed: {gain: 0.1, tau1: 3}}
error_model: {basis: kautz, taps: 3, constraint: explicit, T: [[1, 0], [0, 0.3], [-1, -1]], components: 3, pole: -0.1,
              pole_real: 0.2, pole_imag: 0.7, parameters: [b1], sensitivity_order: 2, max_taps: 6, max_components: 5}
estimation: {algorithm: em, max_iterations: 0, time_limit: 7, tolerance: 1.0e-9, restarts: 3, threads: 2, seed: 18446744073709551615,
             initial_state: discard, discard_samples: 9, initial_precision: 0.5, initial_variance: 2, noise_start: zero, offsets: per_experiment, offset_side: input, thinning: 3}
initial: {theta: [0.1, -0.2], weights: [0.25, 0.75], means: [[1, 2], [3, 4]],
          covariances: [[[1, 0], [0, 1]], [[2, 0.5], [0.5, 2]]], noise_variance: 0.3}
effects: [{name: sens_bias, variant: per_experiment, parameters: {deviation: -1}}]
explanation: {max_causes: 2, acceptance: 7, validation_share: 0.4, time_limit: 3, exclude: [act_delay], after_experiments: 5}
resampling: {output: linear, max_age: 0.5, max_jitter: 0.01}
input: {column: volt, topic: /a, field: "effort[0]", scale: 0.1, offset: -1}
output: {column: "w [deg]", topic: /b, field: twist.linear.x, scale: deg, offset: 2}
covariates: [{name: temp, topic: /c, field: data}, {name: "01", column: "1"}]
time: {column: stamp, unit: index, sample_time: 0.02}
experiment: {mode: duration, topic: cut, duration: 2.5, gap: 1, column: run}
full_identification: {share: 0.3, quiet: 4}
bounds: {levels: [0.6, 0.8], frequencies: 50, grid: [1, 2], steps: 9, samples: 333, weight_order: 3, weight_level: 0.85, folds: 5}
limits: {max_experiments: 10, max_samples: 20, min_samples: 5, max_missing: 0.1, max_stray: 0.02, max_request_size: 2,
         max_bag_size: 3, max_saved_files: 4, max_request_time: 5}
bag_directory: /bags
report_directory: /reports
report_each_result: true
live_page: {port: 8080}
store_directory: /store
)"));
}

TEST(ConfigurationYaml, EmptyDocumentGivesTheDefaults) {
  EXPECT_EQ(toJson(parseConfiguration(YAML::Load("{}"))), toJson(Configuration{}));
  EXPECT_EQ(toJson(parseConfiguration(YAML::Node())), toJson(Configuration{}));
}

TEST(ConfigurationYaml, OrdersAreChosenUnlessTheFormOfTheModelIsStated) {
  const auto automatic = [](const std::string& nominal_model) {
    return parseConfiguration(YAML::Load("nominal_model: {" + nominal_model + "}"))
        .nominal_model.orders_auto;
  };
  EXPECT_TRUE(automatic(""));
  EXPECT_TRUE(automatic("max_order: 3, fit: simulation"));
  EXPECT_TRUE(automatic("orders: auto, structure: box_jenkins"));
  EXPECT_FALSE(automatic("nb: 2"));
  EXPECT_FALSE(automatic("structure: continuous, time_constants: 1"));
  EXPECT_FALSE(automatic("orders: given"));
}

TEST(ConfigurationYaml, TheErrorModelIsChosenUnlessItIsStated) {
  const auto errorModel = [](const std::string& value) {
    return parseConfiguration(YAML::Load("error_model: " + value)).error_model;
  };
  EXPECT_EQ(errorModel("{}").basis, BasisKind::automatic);
  EXPECT_EQ(errorModel("{constraint: auto, taps: auto, components: auto}").basis,
            BasisKind::automatic);
  EXPECT_EQ(errorModel("{components: 2}").basis, BasisKind::automatic);
  EXPECT_EQ(errorModel("{taps: 3}").basis, BasisKind::fir);
  EXPECT_EQ(errorModel("{constraint: zero_mean, taps: auto}").basis, BasisKind::fir);
  const ErrorModelOptions paper = errorModel("paper");
  EXPECT_EQ(paper.basis, BasisKind::fir);
  EXPECT_EQ(paper.taps, 2);
  EXPECT_EQ(paper.constraint, Constraint::zero_static_gain);
  EXPECT_TRUE(contains(complaint("error_model: papers"), "error_model"));
}

TEST(ConfigurationYaml, ABasisThatVariesParametersHasAConstraintOfItsOwn) {
  const auto constraint = [](const std::string& error_model) {
    return parseConfiguration(YAML::Load("error_model: {" + error_model + "}"))
        .error_model.constraint;
  };
  EXPECT_EQ(constraint("basis: fir"), Constraint::zero_static_gain);
  EXPECT_EQ(constraint("basis: sensitivity"), Constraint::zero_mean);
  EXPECT_EQ(constraint("basis: parameter_spread"), Constraint::zero_mean);
  EXPECT_EQ(constraint("constraint: free, basis: sensitivity"), Constraint::free);
  EXPECT_TRUE(contains(complaint("error_model: {basis: parameter_spread, constraint: free}"),
                       "error_model.constraint: found free"));
}

TEST(ConfigurationYaml, RoundTripKeepsEveryBit) {
  const Configuration configuration = unusual();
  const json all = toJson(configuration);
  EXPECT_EQ(toJson(configurationFromJson(all)), all);
  EXPECT_EQ(toJson(configurationFromJson(json::parse(all.dump()))), all);
  EXPECT_EQ(toJson(parseConfiguration(YAML::Load(YAML::Dump(toYaml(configuration))))), all);
  EXPECT_EQ(configuration.sample_time, 0.012345678901234567);
  EXPECT_EQ(configuration.estimation.seed, 18446744073709551615u);
  EXPECT_EQ(configuration.covariates.at(1).name, "01");
  EXPECT_EQ(configuration.covariates.at(1).column, "1");
  EXPECT_NO_THROW(configuration.time.validate());
  EXPECT_NEAR(configuration.output.scaled(180), 3.14159265358979 + 2, 1e-13);
}

TEST(ConfigurationYaml, UnusualConfigurationLeavesNoKeyAtItsDefault) {
  const json defaults = toJson(Configuration{}), all = toJson(unusual());
  for (const std::string& path : paths(defaults)) {
    if (path == "resampling.input") continue;  // has one value only
    std::string pointer = "/" + path;
    for (char& letter : pointer) letter = letter == '.' ? '/' : letter;
    EXPECT_NE(all[json::json_pointer(pointer)], defaults[json::json_pointer(pointer)]) << path;
  }
}

TEST(ConfigurationYaml, EveryKeyRefusesAValueOfAnotherType) {
  const std::set<std::string> all = paths(toJson(Configuration{}));
  ASSERT_GT(all.size(), 60u);
  for (const std::string& path : all) {
    const YAML::Node wrong =
        path == "nominal_model.fixed" ? YAML::Node("text") : YAML::Load("{nonsense: 1}");
    const std::string message = complaint(documentWith(path, wrong));
    EXPECT_EQ(message.rfind(path + ": found ", 0), 0u) << path << " gave: " << message;
    EXPECT_TRUE(contains(message, "; expected ")) << message;
  }
}

TEST(ConfigurationYaml, EveryMisspelledKeyNamesTheNearest) {
  for (const std::string& path : paths(toJson(Configuration{}))) {
    const std::string message = complaint(documentWith(path + "x", YAML::Node("1")));
    EXPECT_EQ(message, path + "x: unknown key; did you mean " + path + "?");
  }
  EXPECT_EQ(complaint("nominalmodel: {}"),
            "nominalmodel (line 1): unknown key; did you mean nominal_model?");
}

TEST(ConfigurationYaml, MessagesNameTheLine) {
  EXPECT_EQ(complaint("estimation:\n  seed: 1\n  tolerence: 1\n"),
            "estimation.tolerence (line 3): unknown key; did you mean estimation.tolerance?");
  EXPECT_EQ(complaint("nominal_model:\n  nb: two\n"),
            "nominal_model.nb (line 2): found 'two'; expected a whole number");
  EXPECT_EQ(complaint("covariates:\n  - name: a\n    topik: b\n"),
            "covariates[0].topik (line 3): unknown key; did you mean covariates[0].topic?");
}

TEST(ConfigurationYaml, EnumerationsListWhatIsAllowed) {
  EXPECT_EQ(complaint("{nominal_model: {structure: oe}}"),
            "nominal_model.structure (line 1): found 'oe'; expected one of output_error, arx, "
            "armax, box_jenkins, "
            "continuous, modal");
  EXPECT_TRUE(
      contains(complaint("{nominal_model: {orders: automatic}}"), "expected one of given, auto"));
  EXPECT_TRUE(contains(complaint("{error_model: {constraint: none}}"),
                       "zero_static_gain, zero_mean, free, explicit"));
  EXPECT_TRUE(contains(complaint("{resampling: {input: linear}}"), "expected hold"));
}

TEST(ConfigurationYaml, NumbersMayBeTextButMustBeNumbers) {
  EXPECT_EQ(
      parseConfiguration(YAML::Load("{estimation: {tolerance: '1e-9'}}")).estimation.tolerance,
      1e-9);
  EXPECT_EQ(parseConfiguration(YAML::Load("{nominal_model: {na: '3'}}")).nominal_model.na, 3);
  EXPECT_EQ(parseConfiguration(YAML::Load("{nominal_model: {na: 3.0}}")).nominal_model.na, 3);
  EXPECT_TRUE(
      parseConfiguration(YAML::Load("{nominal_model: {dead_time: yes}}")).nominal_model.dead_time);
  for (const std::string bad : {"1e-6x", "''", ".nan", ".inf", "true", "~", "1 2", "'1,5'"}) {
    EXPECT_TRUE(
        contains(complaint("{estimation: {tolerance: " + bad + "}}"), "estimation.tolerance"))
        << bad;
  }
  for (const std::string bad : {"1.5", "9999999999", "-3000000000", "one"}) {
    EXPECT_TRUE(contains(complaint("{nominal_model: {na: " + bad + "}}"), "nominal_model.na"))
        << bad;
  }
  EXPECT_TRUE(contains(complaint("{estimation: {seed: -1}}"), "a whole number, 0 or above"));
}

TEST(ConfigurationYaml, AutomaticIsAWordNotItsStandIn) {
  EXPECT_EQ(parseConfiguration(YAML::Load("{error_model: {taps: auto}}")).error_model.taps,
            kAutomatic);
  EXPECT_TRUE(contains(complaint("{error_model: {taps: -1}}"), "a whole number or auto"));
  EXPECT_TRUE(contains(complaint("{sample_time: 0}"), "a number or auto"));
  EXPECT_TRUE(contains(complaint("{sample_time: automatic}"), "a number or auto"));
}

TEST(ConfigurationYaml, RangesAreChecked) {
  EXPECT_TRUE(contains(complaint("{nominal_model: {nb: 0}}"),
                       "nominal_model.nb: found 0; allowed: 1 to 50"));
  EXPECT_FALSE(
      complaint("{initial: {weights: [0.5, 0.6], means: [[0], [1]], covariances: [[[1]], [[1]]]}}")
          .empty());
}

TEST(ConfigurationYaml, StructureOfTheDocument) {
  EXPECT_TRUE(contains(complaint("[1, 2]"), "a group of keys"));
  EXPECT_TRUE(contains(complaint("nominal_model: 3"), "nominal_model (line 1): found '3'"));
  EXPECT_TRUE(contains(complaint("{error_model: {T: [[1], [1, 2]]}}"), "error_model.T[1]"));
  EXPECT_TRUE(contains(complaint("seed: 1\nlimits:\n  min_samples: 5\n  min_samples: 6\n"),
                       "limits.min_samples (line 4): the key is given twice"));
  EXPECT_EQ(complaint("nominal_model:\n"), "");  // a heading with all of its keys commented out
}

TEST(ConfigurationYaml, FilesAreNamedInMessages) {
  const auto message = [](const std::string& name) -> std::string {
    try {
      loadConfiguration(std::string(TEST_DATA) + "/configuration/" + name);
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_TRUE(
      contains(message("unknown_key.yaml"), "unknown_key.yaml: nominal_model.structur (line 3)"));
  EXPECT_TRUE(contains(message("not_yaml.yaml"), "not_yaml.yaml, line 2: not YAML"));
  EXPECT_TRUE(contains(message("empty.yaml"), "empty.yaml: the file holds no keys"));
  EXPECT_TRUE(contains(message("holds_itself.yaml"), "holds_itself.yaml, line 2: aliases"));
  EXPECT_THROW(loadConfiguration("/nowhere.yaml"), FileError);
  EXPECT_THROW(loadConfiguration(TEST_DATA), FileError);
}

TEST(ConfigurationYaml, ReferenceStatesEveryKeyAndItsDefault) {
  const std::string path = std::string(PROJECT_FOLDER) + "/config/reference.yaml";
  const Tree reference = treeFromYaml(loadYaml(path));
  EXPECT_EQ(paths(*reference.value), paths(toJson(Configuration{})));
  EXPECT_EQ(toJson(loadConfiguration(path)), toJson(Configuration{}));
}

TEST(ConfigurationYaml, ShippedConfigurationsLoad) {
  const std::string folder = std::string(PROJECT_FOLDER) + "/config/";
  const Configuration first = loadConfiguration(folder + "example1.yaml");
  EXPECT_EQ(first.nominal_model.structure, Structure::box_jenkins);
  EXPECT_EQ(first.estimation.noise_start, NoiseStart::zero);
  EXPECT_EQ(first.error_model.components, 2);
  const Configuration second = loadConfiguration(folder + "example2.yaml");
  EXPECT_EQ(second.nominal_model.structure, Structure::continuous);
  EXPECT_EQ(second.nominal_model.fixed.at("gain"), 1.0);
  EXPECT_EQ(second.nominal_model.nc + second.nominal_model.nd, 0);
}

TEST(EditDistance, CountsInsertionsDeletionsAndReplacements) {
  EXPECT_EQ(editDistance("", ""), 0);
  EXPECT_EQ(editDistance("taps", "taps"), 0);
  EXPECT_EQ(editDistance("", "taps"), 4);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3);
}

}  // namespace
}  // namespace uncertainty_identification
