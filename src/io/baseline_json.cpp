#include "io/baseline_json.h"

#include "io/estimate_binding.h"
#include "io/tree_reader.h"
#include "io/tree_writer.h"

namespace uncertainty_identification {

template <class Archive>
void bind(Archive& archive, ExperimentFit& fit) {
  archive("id", fit.id);
  archive("parameters", fit.parameters);
  archive("delay", fit.delay);
  archive("b", fit.b);
  archive("a", fit.a);
  archive("c", fit.c);
  archive("d", fit.d);
  archive("offset", fit.offset);
  archive("noise_variance", fit.noise_variance);
  archive("log_likelihood", fit.log_likelihood);
}

template <class Archive>
void bind(Archive& archive, Baseline& baseline) {
  archive("method", baseline.method);
  archive("experiments", baseline.fits);
  archive("mean", baseline.mean);
  archive("deviation", baseline.deviation);
  archive("error_models", baseline.error_models);
  archive("omega", baseline.omega);
  archive("magnitude_bands", baseline.magnitude_bands);
}

nlohmann::json toJson(const Baseline& baseline) {
  Baseline copy = baseline;
  TreeWriter writer;
  bind(writer, copy);
  return writer.tree();
}

Baseline baselineFromJson(const nlohmann::json& json) {
  const std::map<std::string, int> no_lines;
  TreeReader reader(json, no_lines, ReadingRule::record);
  Baseline baseline;
  bind(reader, baseline);
  return baseline;
}

}  // namespace uncertainty_identification
