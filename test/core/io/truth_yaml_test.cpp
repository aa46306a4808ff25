#include "io/truth_yaml.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>

#include "io/read_file.h"
#include "io/tree.h"
#include "io/untrusted_yaml.h"
#include "simulation/simulate.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;

const std::string kConfig = std::string(PROJECT_FOLDER) + "/config/";

std::string complaintAbout(const std::string& yaml) {
  try {
    parseTruth(YAML::Load(yaml));
  } catch (const ConfigurationError& error) {
    return error.what();
  }
  return "";
}

/// All paths of a tree's keys, one per line.
std::string keysOf(const json& tree, const std::string& parent = "") {
  std::string all;
  if (!tree.is_object()) return parent + "\n";
  for (const auto& [key, value] : tree.items()) all += keysOf(value, pathOf(parent, key));
  return all;
}

TEST(TruthYaml, ReferenceStatesEveryKeyAndItsDefault) {
  const std::string path = kConfig + "truth_reference.yaml";
  EXPECT_EQ(keysOf(*treeFromYaml(loadYaml(path)).value), keysOf(toJson(Truth{})));
  EXPECT_EQ(toJson(loadTruth(path)), toJson(Truth{}));
}

/// The effects that truth_reference.yaml lists in comments, as YAML.
std::string documentedEffects() {
  std::istringstream lines(readFile(kConfig + "truth_reference.yaml"));
  std::string effects = "effects:\n";
  for (std::string line; std::getline(lines, line);) {
    static const std::regex kEffect("#   ([a-z]+_[a-z0-9_]+: \\{.*\\}).*");
    std::smatch match;
    if (std::regex_match(line, match, kEffect)) effects += "  " + match[1].str() + "\n";
  }
  return effects;
}

TEST(TruthYaml, ReferenceStatesEveryEffectAndItsDefaults) {
  const YAML::Node documented = YAML::Load(documentedEffects());
  std::string by_name =
      "{error_model: {weights: [1], means: [[0]], covariances: [[[1]]]}, effects: {";
  for (const auto& effect : documented["effects"]) by_name += effect.first.Scalar() + ": , ";
  // 35 names of the catalogue, plant_parameter_spread and six of no catalogue
  EXPECT_EQ(documented["effects"].size(), 42u);
  const json defaults = toJson(parseTruth(YAML::Load(by_name + "}}")))["effects"];
  YAML::Node stated = YAML::Clone(documented);
  stated["error_model"] = YAML::Load("{weights: [1], means: [[0]], covariances: [[[1]]]}");
  EXPECT_EQ(toJson(parseTruth(stated))["effects"], defaults);
  const std::string unknown = complaintAbout("effects: {act_dleay: {delay: 2}}");
  EXPECT_EQ(unknown, "effects.act_dleay (line 1): unknown key; did you mean effects.act_delay?");
}

TEST(TruthYaml, RoundTripKeepsEveryBit) {
  const Truth truth = parseTruth(YAML::Load(R"(
sample_time: 0.0123456789012345
experiments: {count: 3, samples: [50, 60, 70]}
input: {kind: multisine, mean: 1, variance: 2, hold: 3, tones: 4}
plant: {structure: first_order, b: [1, 2], a: [0.5], delay: 2, gain: 3, time_constant: 0.4, time_constant_spread: 0.1}
error_model: {basis: laguerre, taps: 2, constraint: free, pole: 0.3, weights: [1], means: [[0, 1]],
              covariances: [[[1, 0.5], [0.5, 1]]]}
sensor: {missing: 0.25}
noise: {variance: 0.1, c: [0.1], d: [0.8], start: stationary}
covariates: {temp: true}
effects:
  act_deadzone: {width: 0.1, negative_width: 0.3}
  sens_bias: {per_experiment: true, deviation: 0.7}
  noise_hetero: {share: 0.3, driver: x}
  plant_aging: {shift: [0.1, 0.2]}
  exp_mode:
    mean: [3, 4]
)"));
  const json all = toJson(truth);
  EXPECT_EQ(toJson(parseTruth(yamlFromTree(all))), all);
  EXPECT_EQ(truth.samplesOf(2), 70);
  EXPECT_EQ(all["experiments"]["samples"], json({50, 60, 70}));
  EXPECT_EQ(all["effects"].size(), 5u);
  EXPECT_EQ(all["effects"]["sens_bias"],
            json({{"bias", 0.1}, {"per_experiment", true}, {"deviation", 0.7}}));
}

TEST(TruthYaml, BadTruthsAreRefused) {
  EXPECT_NE(complaintAbout("error_model: {basis: sensitivity, taps: 1, weights: [1], means: [[0]], "
                           "covariances: [[[1]]]}")
                .find("error_model.basis: found sensitivity"),
            std::string::npos);
  EXPECT_EQ(complaintAbout("plant: {gian: 1}"),
            "plant.gian (line 1): unknown key; did you mean plant.gain?");
  EXPECT_NE(complaintAbout("input: {kind: noise}").find("white_noise, prbs, steps, multisine"),
            std::string::npos);
  for (const auto& [yaml, key] : std::vector<std::pair<std::string, std::string>>{
           {"sample_time: 0", "sample_time"},
           {"experiments: {count: 0}", "experiments.count"},
           {"experiments: {count: 2, samples: [1, 2, 3]}", "experiments.samples"},
           {"experiments: {samples: 0}", "experiments.samples"},
           {"experiments: {samples: []}", "experiments.samples"},
           {"input: {variance: -1}", "input.variance"},
           {"input: {hold: 0}", "input.hold"},
           {"input: {tones: 0}", "input.tones"},
           {"input: {kind: multisine, tones: 50}", "input.tones"},
           {"plant: {b: []}", "plant.b"},
           {"plant: {a: [1.2]}", "plant.a"},
           {"plant: {delay: -1}", "plant.delay"},
           {"plant: {time_constant: 0}", "plant.time_constant"},
           {"plant: {time_constant_spread: 1}", "plant.time_constant_spread"},
           {"error_model: {weights: [1], means: [[1, 2]], covariances: [[[1, 0], [0, 1]]]}",
            "error_model.means"},
           {"error_model: {taps: auto, weights: [1], means: [[1]], covariances: [[[1]]]}",
            "error_model.taps"},
           {"error_model: {weights: [0.5], means: [[1]], covariances: [[[1]]]}", "error_model"},
           {"sensor: {missing: 1}", "sensor.missing"},
           {"input: {amplitude_spread: 1}", "input.amplitude_spread"},
           {"effects: {act_delay: {delay: -1}}", "effects.act_delay.delay"},
           {"effects: {act_quantisation: {step: 0}}", "effects.act_quantisation.step"},
           {"effects: {act_deadzone: {negative_width: -1}}", "effects.act_deadzone.negative_width"},
           {"effects: {act_loss: {loss: 1.5}}", "effects.act_loss.loss"},
           {"effects: {plant_pole: {pole: 1}}", "effects.plant_pole.pole"},
           {"effects: {plant_resonance: {frequency: 4}}", "effects.plant_resonance.frequency"},
           {"effects: {plant_coulomb: {smoothing: 0}}", "effects.plant_coulomb.smoothing"},
           {"effects: {plant_parameter_spread: {parameter: b2}}",
            "effects.plant_parameter_spread.parameter"},
           {"effects: {plant_aging: }", "effects.plant_aging.shift"},
           {"effects: {sens_outliers: {probability: 1}}", "effects.sens_outliers.probability"},
           {"effects: {noise_colour: {d1: -1.5}}", "effects.noise_colour"},
           {"effects: {noise_tails: {degrees_of_freedom: 2}}",
            "effects.noise_tails.degrees_of_freedom"},
           {"effects: {noise_hetero: {driver: y}}", "effects.noise_hetero.driver"},
           {"effects: {exp_mode: }", "effects.exp_mode.mean"},
           {"effects: {exp_jitter: {width: 0.5}}", "effects.exp_jitter.width"},
           {"effects: {unk_burst: {radius: 1}}", "effects.unk_burst.radius"},
           {"noise: {variance: -1}", "noise.variance"},
           {"noise: {d: [1], start: stationary}", "noise.d"}}) {
    EXPECT_EQ(complaintAbout(yaml).rfind(key, 0), 0u) << yaml << " gave: " << complaintAbout(yaml);
  }
  EXPECT_EQ(complaintAbout("plant: {a: [-1.0]}"), "");  // an integrator
}

TEST(TruthYaml, ShippedExamplesAreThePapers) {
  const Truth first = loadTruth(kConfig + "example1_truth.yaml");
  EXPECT_EQ(first.input.variance, 10);
  EXPECT_EQ(first.plant.a, Eigen::VectorXd::Constant(1, 0.5));
  EXPECT_EQ(first.noise.d, Eigen::VectorXd::Constant(1, 0.8));
  EXPECT_EQ(first.error_model.mixture.means.at(1), Eigen::VectorXd::Constant(1, 1));
  const Truth second = loadTruth(kConfig + "example2_truth.yaml");
  EXPECT_EQ(second.input.variance, 42);
  EXPECT_EQ(second.plant.time_constant, 0.01);
  EXPECT_EQ(second.error_model.mixture.components(), 0);
}

TEST(TruthYaml, AnswerTellsWhatWasDrawn) {
  const Truth truth = loadTruth(kConfig + "example1_truth.yaml");
  const json answer = answerJson(truth, 3);
  EXPECT_EQ(answer["format"], "uncertainty_identification/answer/1");
  EXPECT_EQ(answer["seed"], 3);
  EXPECT_EQ(answer["truth"], toJson(truth));
  ASSERT_EQ(answer["experiments"].size(), 100u);
  const DrawnSystem system = drawSystem(truth, 3, 42);
  EXPECT_EQ(answer["experiments"][42]["id"], "exp_000042");
  EXPECT_EQ(answer["experiments"][42]["component"], system.component.value());
  EXPECT_EQ(answer["experiments"][42]["xi"][0], system.xi(0));
  EXPECT_TRUE(answer["experiments"][42]["time_constant"].is_null());
  EXPECT_EQ(answer["experiments"][42]["effects"]["clock_shift"], 0);
}

TEST(TruthYaml, AnswerTellsWhatIsHidden) {
  const Truth truth = parseTruth(YAML::Load("effects: {exp_clock: {deviation: 2}}"));
  const json answer = answerJson(truth, 3);
  EXPECT_EQ(answer["truth"]["effects"], json({{"exp_clock", {{"deviation", 2.0}}}}));
  EXPECT_EQ(answer["experiments"][1]["effects"]["clock_shift"],
            drawSystem(truth, 3, 1).effects.clock_shift);
}

}  // namespace
}  // namespace uncertainty_identification
