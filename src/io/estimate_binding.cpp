#include "io/estimate_binding.h"

#include "io/archive.h"
#include "io/configuration_binding.h"
#include "uncertainty_identification/data/rejected_experiment.h"

namespace uncertainty_identification {

const EnumNames<Termination>& enumNames(Termination) {
  static const EnumNames<Termination> kNames = [] {
    EnumNames<Termination> names;
    for (const Termination termination :
         {Termination::not_run, Termination::converged, Termination::iteration_limit,
          Termination::stalled, Termination::cancelled, Termination::time_limit}) {
      names.emplace_back(termination, toString(termination));
    }
    return names;
  }();
  return kNames;
}

void bindScalar(Archive& archive, ParameterEstimate& parameter) {
  archive("unit", parameter.unit);
  archive("value", parameter.value);
  archive("standard_error", parameter.standard_error);
  archive("robust_standard_error", parameter.robust_standard_error);
}

void bind(Archive& archive, ParameterEstimate& parameter) {
  archive("name", parameter.name);
  bindScalar(archive, parameter);
}

void bind(Archive& archive, Band& band) {
  archive("level", band.level);
  archive("lower", band.lower);
  archive("upper", band.upper);
}

void bind(Archive& archive, Bands& bands) {
  archive("pointwise", bands.pointwise);
  archive("simultaneous", bands.simultaneous);
  archive("monte_carlo_error", bands.monte_carlo_error);
}

void bind(Archive& archive, RejectedExperiment& rejected) {
  archive("id", rejected.id);
  archive("reason", rejected.reason);
}

void bind(Archive& archive, ExperimentEstimate& experiment) {
  archive("id", experiment.id);
  archive("samples", experiment.samples);
  archive("responsibilities", experiment.responsibilities);
  archive("error_mean", experiment.error_mean);
  archive("log_likelihood", experiment.log_likelihood);
}

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

void bind(Archive& archive, ErrorModelEstimate& model) {
  bindErrorModel(archive, "varied_parameters", model.options);
  archive("T", model.T);  // in place of the options' own, which is empty unless explicit
  bindMixture(archive, model.mixture);
  archive("parameters", model.parameters);
}

void bind(Archive& archive, EffectEstimate& effect) {
  archive("name", effect.name);
  archive("variant", effect.variant);
  archive("parameters", effect.parameters);
}

void bind(Archive& archive, StepSummary& step) {
  archive("norm", step.norm);
  archive("gradient_norm", step.gradient_norm);
  archive("accepted", step.accepted);
  archive("seconds", step.seconds);
}

void bind(Archive& archive, TracePoint& point) {
  archive("iteration", point.iteration);
  archive("passes", point.passes);
  archive("log_likelihood", point.log_likelihood);
  archive("step", whenPresent(point.step));
}

void bind(Archive& archive, Candidate& candidate) {
  archive("choice", candidate.choice);
  archive("description", candidate.description);
  archive("parameters", candidate.parameters);
  archive("log_likelihood", orNull(candidate.log_likelihood));
  archive("bic", orNull(candidate.bic));
  archive("validation_fit", orNull(candidate.validation_fit));
  archive("chosen", candidate.chosen);
  archive.ifThere("held_out_density", orNull(candidate.held_out_density));
}

void bind(Archive& archive, Validation& validation) {
  archive("experiments", validation.experiments);
  archive("simulation_fit_percent", validation.simulation_fit_percent);
  archive("simulation_fit_percent_pooled", validation.simulation_fit_percent_pooled);
  archive.ifThere("at_rest_fit_percent_pooled", validation.at_rest_fit_percent_pooled);
  archive("log_density_per_experiment", validation.log_density_per_experiment);
}

void bind(Archive& archive, ResidualTests& tests) {
  archive("samples", tests.samples);
  archive("autocorrelation", tests.autocorrelation);
  archive("cross_correlation", tests.cross_correlation);
  archive("whiteness_p_value", tests.whiteness_p_value);
  archive("independence_p_value", tests.independence_p_value);
  archive.ifThere("linearity_p_value", tests.linearity_p_value);
  archive.ifThere("nonlinear_share", tests.nonlinear_share);
}

void bind(Archive& archive, StructureError& error) {
  archive("omega", error.omega);
  archive("relative", error.relative);
}

void bind(Archive& archive, Trust& trust) {
  archive("trusted", trust.trusted);
  archive("reasons", trust.reasons);
}

void bind(Archive& archive, Estimate& estimate) {
  Word format{"uncertainty_identification/result/1"};
  archive("format", format);
  archive("version", estimate.version);
  archive("configuration", withDefaults(estimate.configuration));
  archive("seed", estimate.configuration.estimation.seed);
  archive("data_fingerprint", estimate.data_fingerprint);
  archive.section("experiments", [&estimate](Archive& section) {
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
                  [&estimate](Archive& section) { bindScalar(section, estimate.noise_variance); });
  archive.section("offsets", [&estimate](Archive& section) {
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
  archive.ifThere("simulation_fit_percent", orNull(estimate.simulation_fit_percent));
  archive("validation", estimate.validation);
  archive("residual_tests", estimate.residual_tests);
  archive("candidates", estimate.candidates);
  archive.ifThere("variation", estimate.variation);
  archive.ifThere("structure_error", estimate.structure_error);
  archive.ifThere("trust", estimate.trust);
  archive("warnings", estimate.warnings);
}

}  // namespace uncertainty_identification
