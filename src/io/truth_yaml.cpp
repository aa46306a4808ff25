#include "io/truth_yaml.h"

#include <nlohmann/json.hpp>

#include "io/tree_reader.h"
#include "io/tree_writer.h"
#include "io/truth_binding.h"
#include "io/untrusted_yaml.h"
#include "uncertainty_identification/version.h"

namespace uncertainty_identification {

Truth parseTruth(const YAML::Node& node) { return readYamlConfiguration<Truth>(node); }

Truth loadTruth(const std::string& path) { return loadYamlAs(path, parseTruth); }

nlohmann::json toJson(const Truth& truth) { return writtenTree(truth); }

nlohmann::json answerJson(const Truth& truth, std::uint64_t seed) {
  nlohmann::json experiments = nlohmann::json::array();
  for (int r = 0; r < truth.experiments; ++r) {
    const DrawnSystem system = drawSystem(truth, seed, r);
    nlohmann::json entry{
        {"id", experimentId(r)}, {"component", nullptr}, {"time_constant", nullptr}};
    entry["xi"] = std::vector<double>(system.xi.data(), system.xi.data() + system.xi.size());
    entry["effects"] = writtenTree(system.effects);
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
