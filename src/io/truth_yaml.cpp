#include "io/truth_yaml.h"

#include "io/configuration_binding.h"
#include "io/effects_binding.h"
#include "io/tree.h"
#include "io/tree_reader.h"
#include "io/tree_writer.h"
#include "simulation/simulate.h"
#include "uncertainty_identification/version.h"

namespace uncertainty_identification {

/// Reads or writes any part of a truth that describes itself by a function fields().
template <class Archive, class Part>
auto bind(Archive& archive, Part& part) -> decltype(part.fields(), void()) {
  for (const Field& field : part.fields())
    std::visit([&](auto* value) { archive(field.key, *value); }, field.value);
}

template <class Archive>
void bind(Archive& archive, EffectsTruth& effects) {
  effects.forEach(
      [&archive](const std::string& name, auto& effect) { archive(name, whenPresent(effect)); });
}

template <class Archive>
void bind(Archive& archive, ErrorModelTruth& error_model) {
  bindBasis(archive, error_model.basis);
  bindMixture(archive, error_model.mixture);
}

template <class Archive>
void bind(Archive& archive, Truth& truth) {
  archive("sample_time", truth.sample_time);
  archive.section("experiments", [&truth](auto& section) {
    section("count", truth.experiments);
    section("samples", oneOrMany(truth.samples));
  });
  archive("input", truth.input);
  archive("plant", truth.plant);
  archive("error_model", truth.error_model);
  archive("sensor", truth.sensor);
  archive("noise", truth.noise);
  archive("covariates", truth.covariates);
  archive("effects", truth.effects);
}

Truth parseTruth(const YAML::Node& node) {
  const Tree tree = treeFromYaml(node);
  Truth truth;
  TreeReader reader(tree.value, tree.lines, ReadingRule::configuration);
  bind(reader, truth);
  reader.finish();
  truth.validate();
  return truth;
}

Truth loadTruth(const std::string& path) { return loadYamlAs(path, parseTruth); }

nlohmann::json toJson(const Truth& truth) {
  Truth copy = truth;
  TreeWriter writer;
  bind(writer, copy);
  return writer.tree();
}

nlohmann::json answerJson(const Truth& truth, std::uint64_t seed) {
  nlohmann::json experiments = nlohmann::json::array();
  for (int r = 0; r < truth.experiments; ++r) {
    const DrawnSystem system = drawSystem(truth, seed, r);
    const EffectDraws& draws = system.effects;
    nlohmann::json entry{
        {"id", experimentId(r)}, {"component", nullptr}, {"time_constant", nullptr}};
    entry["xi"] = std::vector<double>(system.xi.data(), system.xi.data() + system.xi.size());
    entry["effects"] = {{"parameter_deviation", draws.parameter_deviation},
                        {"initial_state", draws.initial_state},
                        {"bias", draws.bias},
                        {"drift", draws.drift},
                        {"hum_phase", draws.hum_phase},
                        {"clock_shift", draws.clock_shift}};
    if (system.component) entry["component"] = *system.component;
    if (system.time_constant) entry["time_constant"] = *system.time_constant;
    experiments.push_back(entry);
  }
  return {{"format", "uncertainty_identification/answer/1"},
          {"version", version()},
          {"seed", seed},
          {"truth", toJson(truth)},
          {"experiments", experiments}};
}

}  // namespace uncertainty_identification
