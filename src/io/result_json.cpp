#include "uncertainty_identification/io/result_json.h"

#include <limits>

#include "io/baseline_json.h"
#include "io/bounds_json.h"
#include "io/configuration_binding.h"
#include "io/estimate_binding.h"
#include "io/json_file.h"
#include "io/tree_reader.h"
#include "io/tree_writer.h"

namespace uncertainty_identification {

const EnumNames<Termination>& enumNames(Termination) {
  static const EnumNames<Termination> kNames = [] {
    EnumNames<Termination> names;
    for (const Termination termination :
         {Termination::not_run, Termination::converged, Termination::iteration_limit,
          Termination::stalled, Termination::cancelled}) {
      names.emplace_back(termination, toString(termination));
    }
    return names;
  }();
  return kNames;
}

template <class Archive>
void bind(Archive& archive, RejectedExperiment& rejected) {
  archive("id", rejected.id);
  archive("reason", rejected.reason);
}

template <class Archive>
void bind(Archive& archive, ExperimentEstimate& experiment) {
  archive("id", experiment.id);
  archive("samples", experiment.samples);
  archive("responsibilities", experiment.responsibilities);
  archive("error_mean", experiment.error_mean);
  archive("log_likelihood", experiment.log_likelihood);
}

template <class Archive>
void bind(Archive& archive, NominalModelEstimate& model) {
  archive("structure", model.structure);
  archive("delay", model.delay);
  archive("sample_time", model.sample_time);
  archive("b", model.b);
  archive("a", model.a);
  archive("c", model.c);
  archive("d", model.d);
  archive("parameters", model.parameters);
  archive("covariance", model.covariance);
}

template <class Archive>
void bind(Archive& archive, ErrorModelEstimate& model) {
  bindErrorModel(archive, "varied_parameters", model.options);
  archive("T", model.T);  // in place of the options' own, which is empty unless explicit
  bindMixture(archive, model.mixture);
  archive("parameters", model.parameters);
}

template <class Archive>
void bind(Archive& archive, EffectEstimate& effect) {
  archive("name", effect.name);
  archive("variant", effect.variant);
  archive("parameters", effect.parameters);
}

template <class Archive>
void bind(Archive& archive, StepSummary& step) {
  archive("norm", step.norm);
  archive("gradient_norm", step.gradient_norm);
  archive("accepted", step.accepted);
  archive("seconds", step.seconds);
}

template <class Archive>
void bind(Archive& archive, TracePoint& point) {
  archive("iteration", point.iteration);
  archive("passes", point.passes);
  archive("log_likelihood", point.log_likelihood);
  archive("step", whenPresent(point.step));
}

template <class Archive>
void bind(Archive& archive, Candidate& candidate) {
  archive("choice", candidate.choice);
  archive("description", candidate.description);
  archive("parameters", candidate.parameters);
  archive("log_likelihood", orNull(candidate.log_likelihood));
  archive("bic", orNull(candidate.bic));
  archive("validation_fit", orNull(candidate.validation_fit));
  archive("chosen", candidate.chosen);
}

template <class Archive>
void bind(Archive& archive, Validation& validation) {
  archive("experiments", validation.experiments);
  archive("simulation_fit_percent", validation.simulation_fit_percent);
  archive("simulation_fit_percent_pooled", validation.simulation_fit_percent_pooled);
  archive("log_density_per_experiment", validation.log_density_per_experiment);
}

template <class Archive>
void bind(Archive& archive, ResidualTests& tests) {
  archive("samples", tests.samples);
  archive("autocorrelation", tests.autocorrelation);
  archive("cross_correlation", tests.cross_correlation);
  archive("whiteness_p_value", tests.whiteness_p_value);
  archive("independence_p_value", tests.independence_p_value);
}

template <class Archive>
void bind(Archive& archive, Estimate& estimate) {
  Word format{"uncertainty_identification/result/1"};
  archive("format", format);
  archive("version", estimate.version);
  archive("configuration", withDefaults(estimate.configuration));
  archive("seed", estimate.configuration.estimation.seed);
  archive("data_fingerprint", estimate.data_fingerprint);
  archive.section("experiments", [&estimate](auto& section) {
    section("count", estimate.experiment_count);
    section("samples", estimate.sample_count);
    section("rejected", estimate.rejected);
    section("estimates", estimate.experiments);
  });
  archive("nominal_model", estimate.nominal_model);
  archive("error_model", estimate.error_model);
  archive("effects", estimate.effects);
  archive("joint_covariance", estimate.joint_covariance);
  archive.section("noise_variance",
                  [&estimate](auto& section) { bindScalar(section, estimate.noise_variance); });
  archive.section("offsets", [&estimate](auto& section) {
    section("u", estimate.offset_u);
    section("y", estimate.offset_y);
  });
  archive("log_likelihood", estimate.log_likelihood);
  archive("bic", estimate.bic);
  archive("termination", estimate.termination);
  archive("message", estimate.message);
  archive("iterations", estimate.iterations);
  archive("passes", estimate.passes);
  archive("seconds", estimate.seconds);
  archive("trace", estimate.trace);
  archive("validation", estimate.validation);
  archive("residual_tests", estimate.residual_tests);
  archive("candidates", estimate.candidates);
  archive("warnings", estimate.warnings);
}

nlohmann::json toJson(const Estimate& estimate) {
  Estimate copy = estimate;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (copy.validation.experiments.empty()) copy.validation = {{}, {}, kNone, kNone};
  if (copy.residual_tests.autocorrelation.empty()) copy.residual_tests = {0, {}, {}, kNone, kNone};
  TreeWriter writer;
  bind(writer, copy);
  nlohmann::json tree = writer.tree();
  tree["bounds"] = nlohmann::json::object();
  return tree;
}

Estimate estimateFromJson(const nlohmann::json& json) {
  const std::map<std::string, int> no_lines;
  TreeReader reader(json, no_lines, ReadingRule::record);
  Estimate estimate;
  bind(reader, estimate);
  estimate.configuration.validate();
  ErrorModelOptions& options = estimate.error_model.options;
  if (options.constraint != Constraint::explicit_matrix) options.T.resize(0, 0);
  if (estimate.validation.experiments.empty()) estimate.validation = {};
  if (estimate.residual_tests.autocorrelation.empty()) estimate.residual_tests = {};
  return estimate;
}

nlohmann::json toJson(const Result& result) {
  nlohmann::json tree = toJson(result.estimate);
  if (result.bounds) tree["bounds"] = toJson(*result.bounds);
  if (result.baseline) tree["baseline"] = toJson(*result.baseline);
  return tree;
}

void saveResult(const std::string& path, const Result& result) { saveJson(path, toJson(result)); }

Result loadResult(const std::string& path) {
  return loadJsonAs(path, [](const nlohmann::json& tree) {
    Result result{estimateFromJson(tree), {}, {}};
    if (tree.contains("baseline")) result.baseline = baselineFromJson(tree["baseline"]);
    if (tree.contains("bounds") && !tree["bounds"].empty())
      result.bounds = boundsFromJson(tree["bounds"]);
    return result;
  });
}

}  // namespace uncertainty_identification
