#include "uncertainty_identification/io/explanation_json.h"

#include <nlohmann/json.hpp>

#include "io/estimate_binding.h"
#include "io/json_file.h"
#include "io/own_simulation_binding.h"
#include "io/result_checks.h"
#include "io/tree_reader.h"
#include "io/tree_writer.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {

void bind(Archive& archive, Check& check) {
  archive("name", check.name);
  archive("statistic", check.statistic);
  archive("p_value", check.p_value);
  archive("passed", check.passed);
  archive("where", check.where);
}

void bind(Archive& archive, Comparison& comparison) {
  archive("before", comparison.before);
  archive("after", comparison.after);
}

void bind(Archive& archive, Gain& gain) {
  archive.section("held_out_log_density_per_experiment", [&gain](Archive& section) {
    section("value", gain.log_density);
    section("standard_error", gain.standard_error);
    section("lower_90", gain.lower_90);
    section("upper_90", gain.upper_90);
  });
  archive("nrmse_fit_percent", gain.nrmse_fit_percent);
  archive("coverage_50", gain.coverage_50);
  archive("coverage_90", gain.coverage_90);
  archive("coverage_95", gain.coverage_95);
  archive("noise_variance", gain.noise_variance);
  archive("bode_area", gain.bode_area);
}

void bind(Archive& archive, CauseParameter& parameter) {
  archive("name", parameter.name);
  archive("value", parameter.value);
  archive("standard_error", parameter.standard_error);
  archive("lower_90", parameter.lower_90);
  archive("upper_90", parameter.upper_90);
  archive("unit", parameter.unit);
}

void bind(Archive& archive, PlaceAndShape& what) {
  archive("name", what.name);
  archive("place", what.place);
  archive("shape", what.shape);
  archive("covariate", what.covariate);
}

void bind(Archive& archive, CurvePicture& curve) {
  archive("of", curve.of);
  archive("unit", curve.unit);
  archive("signal", curve.signal);
  archive("value", curve.value);
  archive("lower_90", curve.lower_90);
  archive("upper_90", curve.upper_90);
}

void bind(Archive& archive, ShapeValue& value) {
  archive("name", value.name);
  archive("value", value.value);
  archive("standard_error", value.standard_error);
}

void bind(Archive& archive, SimulationCause& cause) {
  archive("name", cause.what.name);
  archive("place", cause.what.place);
  archive("shape", cause.what.shape);
  archive("covariate", cause.what.covariate);
  archive("description", cause.description);
  archive("advice", cause.advice);
  archive("values", cause.values);
  archive("curve", cause.curve);
  archive("ties", cause.ties);
  archive("fit_before", cause.fit_before);
  archive("fit_after", cause.fit_after);
}

void bind(Archive& archive, SimulatedWindow& window) {
  archive("experiment", window.experiment);
  archive("start", window.start);
  archive("sample_time", window.sample_time);
  archive("measured", window.measured);
  archive("before", window.before);
  archive("after", window.after);
}

void bind(Archive& archive, SimulationCauses& simulation) {
  archive("preparation", simulation.preparation);
  archive("skipped", simulation.skipped);
  archive("order", simulation.order);
  archive.ifThere("lasting_oscillation", simulation.lasting_oscillation);
  archive.ifThere("own_levels", simulation.own_levels);
  archive("causes", simulation.causes);
  archive("held_out_error_ratio", simulation.held_out_error_ratio);
  archive.ifThere("difference", simulation.difference);
  archive("fit_before", simulation.fit_before);
  archive("fit_after", simulation.fit_after);
  archive.ifThere("unpredictable_share", simulation.unpredictable_share);
  archive("pictures", simulation.pictures);
  archive("ended_early", simulation.ended_early);
  archive("seconds", simulation.seconds);
}

void bind(Archive& archive, Cause& cause) {
  archive("name", cause.name);
  archive("variant", cause.variant);
  archive("group", cause.group);
  archive("description", cause.description);
  archive("confidence", cause.confidence);
  archive("equivalent", cause.equivalent);
  archive("parameters", cause.parameters);
  archive("advice", cause.advice);
  archive("gain", orNull(cause.gain));
  archive("simulation", orNull(cause.simulation));
}

void bind(Archive& archive, TriedEffect& tried) {
  archive("name", tried.name);
  archive("variant", tried.variant);
  archive("score", tried.score);
  archive("held_out_gain", tried.held_out_gain);
  archive("standard_error", tried.standard_error);
}

void bind(Archive& archive, ExperimentPicture& picture) {
  archive("id", picture.id);
  archive("sample_time", picture.sample_time);
  archive("input", picture.input);
  archive("measured", picture.measured);
  archive("simulated_before", picture.simulated_before);
  archive("simulated_after", picture.simulated_after);
  archive("deviation_before", picture.deviation_before);
  archive("deviation_after", picture.deviation_after);
}

void bind(Archive& archive, ResidualPicture& picture) {
  archive("autocorrelation", picture.autocorrelation);
  archive("cross_correlation", picture.cross_correlation);
  archive("confidence_95", picture.confidence_95);
  archive("frequency", picture.frequency);
  archive("spectrum", picture.spectrum);
  archive("input_level", picture.input_level);
  archive("residual_of_input", picture.residual_of_input);
  archive("output_level", picture.output_level);
  archive("residual_of_output", picture.residual_of_output);
  archive("time", picture.time);
  archive("residual_of_time", picture.residual_of_time);
  archive("variance_of_time", picture.variance_of_time);
  archive("of_experiment", picture.of_experiment);
}

void bind(Archive& archive, Explanation& explanation) {
  Word format{"uncertainty_identification/explanation/2"};
  archive("format", format);
  archive("verdict", explanation.verdict);
  archive("message", explanation.message);
  archive("checks_before", explanation.checks_before);
  archive("checks_after", explanation.checks_after);
  archive("causes", explanation.causes);
  archive("simulation", explanation.simulation);
  archive("candidates", explanation.candidates);
  archive("warnings", explanation.warnings);
  archive("held_out", explanation.held_out);
  archive("held_out_fit", explanation.held_out_fit);
  archive("residuals_before", explanation.residual_before);
  archive("residuals_after", explanation.residual_after);
  archive("pictures", explanation.pictures);
  archive("termination", explanation.termination);
  archive("seconds", explanation.seconds);
}

namespace {

/// The model under this key; its errors name the key.
Estimate modelFrom(const nlohmann::json& json, const std::string& key) {
  if (!json.contains(key)) throw ConfigurationError(key + ": missing (is the file truncated?)");
  try {
    return estimateFromJson(json[key]);
  } catch (const ConfigurationError& error) {
    throw ConfigurationError(pathOf(key, error.what()));
  }
}

const char* const kOwnSimulation = "own_simulation";

OwnSimulationFindings ownSimulationFrom(const nlohmann::json& json) {
  try {
    return readRecord<OwnSimulationFindings>(json[kOwnSimulation]);
  } catch (const ConfigurationError& error) {
    throw ConfigurationError(pathOf(kOwnSimulation, error.what()));
  }
}

}  // namespace

nlohmann::json toJson(const Explanation& explanation) {
  nlohmann::json tree = writtenTree(explanation);
  tree["model"] = toJson(explanation.after);
  tree["model_before"] = toJson(explanation.before);
  if (explanation.own_simulation) tree[kOwnSimulation] = writtenTree(*explanation.own_simulation);
  return tree;
}

Explanation explanationFromJson(const nlohmann::json& json) {
  Explanation explanation = readRecord<Explanation>(json);
  explanation.after = modelFrom(json, "model");
  explanation.before = modelFrom(json, "model_before");
  if (json.contains(kOwnSimulation)) explanation.own_simulation = ownSimulationFrom(json);
  requireConsistent(explanation);
  return explanation;
}

void saveExplanation(const std::string& path, const Explanation& explanation) {
  saveJson(path, toJson(explanation));
}

Explanation loadExplanation(const std::string& path) {
  return loadJsonAs(path, explanationFromJson);
}

}  // namespace uncertainty_identification
