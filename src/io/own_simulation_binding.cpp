#include "io/own_simulation_binding.h"

#include <cmath>

namespace uncertainty_identification {
namespace {

/// Text and lists that are written only where they say something: a configuration shows the way in
/// which the simulation was given, and no other.
template <class Value>
void bindGiven(Archive& archive, const char* key, Value& value) {
  if (archive.reads() || !value.empty()) archive(key, value);
}

/// Names with values, or a list of names: those of an FMU, which holds their values.
void bindParameters(Archive& archive, std::map<std::string, OwnParameterOptions>& parameters) {
  if (!archive.hasList("parameters")) return bindGiven(archive, "parameters", parameters);
  std::vector<std::string> names;
  archive("parameters", names);
  for (const std::string& name : names) parameters[name] = {};
}

}  // namespace

void bind(Archive& archive, OwnParameterOptions& parameter) {
  if (archive.reads() || std::isfinite(parameter.value)) archive("value", parameter.value);
  archive("unit", parameter.unit);
}

void bind(Archive& archive, OwnModelOptions& model) {
  archive("domain", model.domain);
  if (archive.reads() || model.num.size() > 0) archive("num", model.num);
  if (archive.reads() || model.den.size() > 0) archive("den", model.den);
  bindGiven(archive, "zeros", model.zeros);
  bindGiven(archive, "poles", model.poles);
  for (const std::string& name : physicalNames()) {
    std::optional<double> value;
    if (const auto found = model.physical.find(name); found != model.physical.end())
      value = found->second;
    archive(name, whenPresent(value));
    if (value) model.physical[name] = *value;
  }
  archive("sample_time", model.sample_time);
}

void bind(Archive& archive, OwnSimulationOptions& options) {
  if (archive.reads()) options.has_model = archive.has("model");
  if (archive.reads() || options.has_model) archive("model", options.model);
  bindGiven(archive, "result", options.result);
  bindGiven(archive, "command", options.command);
  bindGiven(archive, "fmu", options.fmu);
  bindGiven(archive, "input", options.input);
  bindGiven(archive, "output", options.output);
  archive("steps_per_sample", options.steps_per_sample);
  bindParameters(archive, options.parameters);
  archive("time_limit", options.time_limit);
  archive("memory_limit", options.memory_limit);
  bindGiven(archive, "column", options.column);
  bindGiven(archive, "topic", options.topic);
  archive("field", options.field);
  archive("max_simulations", options.max_simulations);
}

void bind(Archive& archive, OwnValue& value) {
  archive("name", value.name);
  archive("unit", value.unit);
  archive("yours", value.yours);
  archive("measured", value.measured);
  archive("standard_error", value.standard_error);
  archive("lower_95", value.lower_95);
  archive("upper_95", value.upper_95);
  archive("run_spread", value.run_spread);
}

void bind(Archive& archive, OwnCause& cause) {
  archive("name", cause.name);
  archive("parameter", cause.parameter);
  archive("description", cause.description);
  archive("remark", cause.remark);
  archive("advice", cause.advice);
  archive("values", cause.values);
  archive("t", cause.t);
  archive("fit_without", cause.fit_without);
  archive("ties", cause.ties);
}

void bind(Archive& archive, OwnRun& run) {
  archive("rank", run.rank);
  archive("id", run.id);
  archive("sample_time", run.sample_time);
  archive("start", run.start);
  archive("measured", run.measured);
  archive("yours", run.yours);
  archive("extended", run.extended);
  archive("fit_yours", run.fit_yours);
  archive("fit_extended", run.fit_extended);
}

void bind(Archive& archive, SimulationParameter& parameter) {
  archive("name", parameter.name);
  archive("value", parameter.value);
  archive("unit", parameter.unit);
}

void bind(Archive& archive, OwnCurve& curve) {
  archive("of", curve.of);
  archive("signal", curve.signal);
  archive("value", curve.value);
}

void bind(Archive& archive, SampledFilter& filter) {
  archive("num", filter.num);
  archive("den", filter.den);
}

void bind(Archive& archive, OwnExtension& extension) {
  archive("sample_time", extension.sample_time);
  archive("parameters", extension.parameters);
  archive("curve", orNull(extension.curve));
  archive("yours", orNull(extension.yours));
  archive("measured", orNull(extension.measured));
  archive("delay", extension.delay);
  archive("lead", extension.lead);
  archive("lag", extension.lag);
  archive("gain", extension.gain);
  archive("offset", extension.offset);
  archive("transient", extension.transient);
}

void bind(Archive& archive, OwnSimulationFindings& findings) {
  archive("simulation", findings.simulation);
  archive("can_rerun", findings.can_rerun);
  archive("surrogate_fit", findings.surrogate_fit);
  archive("sentence", findings.sentence);
  archive("causes", findings.causes);
  archive("fit_before", findings.fit_before);
  archive("fit_after", findings.fit_after);
  archive("held_out", findings.held_out);
  archive("runs", findings.runs);
  archive("structure", findings.structure);
  archive("has_curve_around", findings.has_curve_around);
  archive("extension", findings.extension);
  archive("simulations", findings.simulations);
  archive("ended_early", findings.ended_early);
}

}  // namespace uncertainty_identification
