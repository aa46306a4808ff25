#include "oracle.h"

#include <algorithm>
#include <cmath>

#include "explanation/estimate_fit.h"
#include "explanation/measure.h"
#include "explanation/search_outcome.h"
#include "model/sensitivity.h"
#include "reported_parameters.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification::suite {
namespace {

using Eigen::VectorXd;

/// The variant of the effect in the catalogue of explain() that is hidden.
std::string variantOf(const EffectsTruth& effects, const std::string& name) {
  const SensorEffects& sensor = effects.sensor;
  const bool own = (name == "sens_bias" && sensor.bias->per_experiment) ||
                   (name == "sens_drift" && sensor.drift->per_experiment) ||
                   (name == "sens_hum" && sensor.hum->per_experiment);
  if (own) return "per_experiment";
  if (name == "plant_temp") return "temp";
  if (name == "exp_input2") return "d";
  if (name == "noise_hetero")
    return effects.noise.hetero->driver == HeteroDriver::input ? "u" : "x";
  if (name == "plant_parameter_spread") return effects.plant.parameter_spread->parameter;
  return "";
}

/// The hidden effect as explain() models it.
std::shared_ptr<const Effect> hiddenEffect(const test::HiddenEffect& hidden, const Fit& before,
                                           const FitData& data) {
  DataSummary summary = summarise(data.experiments());
  summary.regressors = before.model->regressors();
  const NominalModel& nominal = before.model->nominal();
  summary.plant_parameters =
      plantParameters(nominal, before.at.parameters.head(nominal.parameterCount()));
  const std::string& name = hidden.names.front();
  return findEffect(catalogue(summary), name, variantOf(hidden.truth.effects, name));
}

/// The true parameters of the effect, as the extended model states them.
VectorXd truePsi(const Effect& effect, const Truth& truth,
                 const std::vector<Experiment>& training) {
  const std::map<std::string, double> values = reportedParameters(truth, training);
  VectorXd psi = VectorXd::Zero(effect.parameterCount());
  for (int i = 0; i < effect.parameterCount(); ++i) {
    const EffectParameter& of = effect.description().parameters[static_cast<std::size_t>(i)];
    const auto value = valueOf(values, effect.name(), effect.description().variant, of.name);
    if (!value) continue;
    psi[i] = of.log_variance ? 2 * std::log(*value) - std::log(truth.noise.variance) : *value;
  }
  return psi;
}

/// The extended model with all parameters at their true values.
Fit atTruth(const Fit& before, const std::shared_ptr<const Effect>& effect, const Truth& truth,
            const FitData& data) {
  Polynomials p;
  p.delay = truth.plant.delay;
  p.b = truth.plant.b;
  p.a = truth.plant.a;
  p.c = truth.noise.c;
  p.d = truth.noise.d;
  const VectorXd theta = before.model->nominal().fromPolynomials(p);
  const VectorXd psi = truePsi(*effect, truth, data.experiments());
  ModelParameters at{VectorXd(theta.size() + psi.size()), truth.error_model.mixture,
                     truth.noise.variance};
  at.parameters << theta, psi;
  Fit fit = evaluated(before.model->with({effect}), at, data);
  for (int round = 0; round < 3; ++round) fit = relinearised(fit, data);
  return fit;
}

}  // namespace

std::optional<double> trueGain(const test::HiddenEffect& hidden, const Estimate& before,
                               const std::vector<Experiment>& training,
                               const std::vector<Experiment>& fresh) {
  const bool stated = hidden.truth.plant.structure == PlantStructure::polynomials;
  if (hidden.names.size() != 1 || !stated) return std::nullopt;
  const FitData train(usedBy(before, training)), held(fresh);
  const FitContext context = contextOf(before, before.configuration.estimation.seed);
  const Fit base = optimise(fitOf(before, train, summarise(train.experiments())), train, context);
  const auto effect = hiddenEffect(hidden, base, train);
  if (effect->stage() == Stage::data || effect->name() == "plant_aging") return std::nullopt;
  const Fit known = atTruth(base, effect, hidden.truth, train);
  const Fit fitted = optimise(known, train, context);
  const VectorXd without = logDensities(base, held);
  return std::max((logDensities(known, held) - without).mean(),
                  (logDensities(fitted, held) - without).mean());
}

}  // namespace uncertainty_identification::suite
