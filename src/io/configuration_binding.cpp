#include "io/configuration_binding.h"

#include <algorithm>
#include <initializer_list>

#include "io/archive.h"
#include "io/own_simulation_binding.h"
#include "math/constants.h"

namespace uncertainty_identification {

namespace {

bool hasAny(const Archive& archive, std::initializer_list<const char*> keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [&archive](const char* key) { return archive.has(key); });
}

/// Whether a configuration states the key, and not as `auto`.
bool states(Archive& archive, const char* key) {
  return archive.has(key) && !archive.isWord(key, "auto");
}

/// What a covariate, the input and the output have in common.
void bindTopic(Archive& archive, SignalOptions& options) {
  archive("topic", options.topic);
  archive("field", options.field);
  if (archive.isWord("scale", "deg"))
    options.scale = kPi / 180;
  else
    archive("scale", options.scale);
  archive("offset", options.offset);
}

/// The input or the output of an identification, which a file may hold as well.
void bindSignalOrColumn(Archive& archive, const char* key, SignalOptions& options) {
  archive.section(key, [&options](Archive& section) {
    section("column", options.column);
    bindTopic(section, options);
  });
}

}  // namespace

void bind(Archive& archive, NominalModelOptions& options) {
  if (archive.reads()) {  // who states a part of the form states all of it
    options.orders_auto = !hasAny(
        archive, {"structure", "nb", "na", "nc", "nd", "delay", "zeros", "time_constants",
                  "resonances", "dead_time", "feedthrough", "center", "directions", "fixed"});
  }
  archive("structure", options.structure);
  archive("orders", oneOf(options.orders_auto, {{false, "given"}, {true, "auto"}}));
  archive("focus", options.focus);
  archive("fit", options.fit);
  archive("max_order", options.max_order);
  archive("max_delay", options.max_delay);
  archive("nb", options.nb);
  archive("na", options.na);
  archive("nc", options.nc);
  archive("nd", options.nd);
  archive("delay", options.delay);
  archive("time_constants", options.time_constants);
  archive("resonances", options.resonances);
  archive("zeros", options.zeros);
  archive("dead_time", options.dead_time);
  archive("feedthrough", options.feedthrough);
  archive("center", options.center);
  archive("directions", options.directions);
  archive("fixed", options.fixed);
}

void bindBasis(Archive& archive, ErrorModelOptions& options) {
  archive("basis", options.basis);
  if (archive.reads()) options.constraint = defaultConstraint(options.basis);
  archive("taps", orAutomatic(options.taps, kAutomatic));
  if (!archive.isWord("constraint", "auto")) archive("constraint", options.constraint);
  archive("T", options.T);
  archive("pole", options.pole);
  archive("pole_real", options.pole_real);
  archive("pole_imag", options.pole_imag);
}

void bindErrorModel(Archive& archive, const char* parameters_key, ErrorModelOptions& options) {
  bindBasis(archive, options);
  archive(parameters_key, options.parameters);
  archive("sensitivity_order", options.sensitivity_order);
  archive("components", orAutomatic(options.components, kAutomatic));
  archive("max_taps", options.max_taps);
  archive("max_components", options.max_components);
}

void bind(Archive& archive, ErrorModelOptions& options) {
  if (archive.reads()) {
    const bool stated = states(archive, "basis") || states(archive, "constraint") ||
                        states(archive, "taps") || hasAny(archive, {"T", "parameters"});
    options.basis = stated ? BasisKind::fir : BasisKind::automatic;
  }
  bindErrorModel(archive, "parameters", options);
}

void bind(Archive& archive, EstimationOptions& options) {
  archive("algorithm", options.algorithm);
  archive("max_iterations", options.max_iterations);
  archive("time_limit", options.time_limit);
  archive("tolerance", options.tolerance);
  archive("restarts", options.restarts);
  archive("threads", orAutomatic(options.threads, kAutomatic));
  archive("seed", options.seed);
  archive("initial_state", options.initial_state);
  archive("discard_samples", options.discard_samples);
  archive("initial_precision", orAutomatic(options.initial_precision, double{kAutomatic}));
  archive("initial_variance", orAutomatic(options.initial_variance, double{kAutomatic}));
  archive("noise_start", options.noise_start);
  archive("offsets", options.offsets);
  archive("offset_side", options.offset_side);
  archive("thinning", orAutomatic(options.thinning, kAutomatic));
}

void bindMixture(Archive& archive, Mixture& mixture) {
  archive("weights", mixture.weights);
  archive("means", mixture.means);
  archive("covariances", mixture.covariances);
}

void bind(Archive& archive, InitialOptions& options) {
  archive("theta", options.theta);
  bindMixture(archive, options.mixture);
  archive("noise_variance", options.noise_variance);
}

void bind(Archive& archive, ResamplingOptions& options) {
  archive("input", options.input);
  archive("output", options.output);
  archive("max_age", options.max_age);
  archive("max_jitter", options.max_jitter);
}

void bind(Archive& archive, SignalOptions& options) {
  archive("name", options.name);
  archive("column", options.column);
  bindTopic(archive, options);
}

void bindSignal(Archive& archive, const char* key, SignalOptions& options) {
  archive.section(key, [&options](Archive& section) { bindTopic(section, options); });
}

void bind(Archive& archive, TimeOptions& options) {
  archive("column", options.column);
  archive("unit", options.unit);
  archive("sample_time", options.sample_time);
}

void bind(Archive& archive, ExperimentOptions& options) {
  archive("mode", options.mode);
  archive("topic", options.topic);
  archive("duration", options.duration);
  archive("gap", options.gap);
  archive("column", options.column);
}

void bind(Archive& archive, BoundsOptions& options) {
  archive("levels", options.levels);
  archive("frequencies", options.frequencies);
  archive("grid", options.grid);
  archive("steps", orAutomatic(options.steps, kAutomatic));
  archive("samples", options.samples);
  archive("weight_order", orAutomatic(options.weight_order, kAutomatic));
  archive("weight_level", options.weight_level);
  archive("folds", options.folds);
}

void bind(Archive& archive, EffectOptions& options) {
  archive("name", options.name);
  archive("variant", options.variant);
  archive("parameters", options.parameters);
}

void bind(Archive& archive, ExplanationOptions& options) {
  archive("max_causes", options.max_causes);
  archive("acceptance", options.acceptance);
  archive("validation_share", options.validation_share);
  archive("time_limit", options.time_limit);
  archive("exclude", options.exclude);
  archive("after_experiments", options.after_experiments);
}

void bind(Archive& archive, FullIdentificationOptions& options) {
  archive("share", options.share);
  archive("quiet", options.quiet);
}

void bind(Archive& archive, LimitOptions& options) {
  archive("max_experiments", options.max_experiments);
  archive("max_samples", options.max_samples);
  archive("min_samples", options.min_samples);
  archive("max_missing", options.max_missing);
  archive("max_stray", options.max_stray);
  archive("max_request_size", options.max_request_size);
  archive("max_bag_size", options.max_bag_size);
  archive("max_saved_files", options.max_saved_files);
  archive("max_request_time", options.max_request_time);
}

void bind(Archive& archive, Configuration& configuration) {
  archive("sample_time", orAutomatic(configuration.sample_time, 0.0));
  archive("nominal_model", configuration.nominal_model);
  if (archive.isWord("error_model", "paper"))
    configuration.error_model = paperErrorModel();
  else
    archive("error_model", configuration.error_model);
  archive("estimation", configuration.estimation);
  archive("initial", configuration.initial);
  archive("effects", configuration.effects);
  archive("explanation", configuration.explanation);
  archive("simulation", whenPresent(configuration.simulation));
  archive("resampling", configuration.resampling);
  bindSignalOrColumn(archive, "input", configuration.input);
  bindSignalOrColumn(archive, "output", configuration.output);
  archive("covariates", configuration.covariates);
  archive("time", configuration.time);
  archive("experiment", configuration.experiment);
  archive("full_identification", configuration.full_identification);
  archive("bounds", configuration.bounds);
  archive("limits", configuration.limits);
  archive("bag_directory", configuration.bag_directory);
  archive("report_directory", configuration.report_directory);
  archive("report_each_result", configuration.report_each_result);
  archive.section("live_page", [&configuration](Archive& section) {
    section("port", configuration.live_page_port);
  });
  archive("store_directory", configuration.store_directory);
}

}  // namespace uncertainty_identification
