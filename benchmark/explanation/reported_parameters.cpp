#include "reported_parameters.h"

#include <cmath>

namespace uncertainty_identification::suite {
namespace {

using Values = std::map<std::string, double>;

/// The parameters that explain() calls by another name than the truth.
const std::map<std::string, std::string> kOtherNames = {
    {"act_hammerstein.quadratic", "act_hammerstein.c2"},
    {"act_hammerstein.cubic", "act_hammerstein.c3"},
    {"act_loss.loss", "act_loss.share"},
    {"act_loss.start", "act_loss.time"},
    {"plant_cubic.coefficient", "plant_cubic.stiffness"},
    {"plant_coulomb.smoothing", "plant_coulomb.width"},
    {"sens_wiener.quadratic", "sens_wiener.c2"},
    {"sens_wiener.cubic", "sens_wiener.c3"},
    {"noise_step.start", "noise_step.time"},
    {"exp_jitter.coupling", "exp_jitter.share"}};

std::string reportedName(const std::string& path) {
  const auto other = kOtherNames.find(path);
  return other == kOtherNames.end() ? path : other->second;
}

/// The value in the units of explain(), which measures times in seconds.
double reportedValue(const std::string& key, double value, double sample_time) {
  if (key == "start") return value * sample_time;
  return key == "frequency" ? value / sample_time : value;
}

/// Adds the numbers among the parameters of an effect, and the entries of vectors by their numbers.
void addFields(const std::string& effect, const Fields& fields, double sample_time,
               Values* values) {
  for (const Field& field : fields) {
    const std::string name = reportedName(effect + "." + field.key);
    if (const auto number = std::get_if<double*>(&field.value))
      (*values)[name] = reportedValue(field.key, **number, sample_time);
    if (const auto vector = std::get_if<Eigen::VectorXd*>(&field.value)) {
      for (int i = 0; i < (*vector)->size(); ++i)
        (*values)[name + std::to_string(i + 1)] = (**vector)(i);
    }
  }
}

/// Mean of a covariate over all samples of all experiments.
double meanOf(const std::string& name, const std::vector<Experiment>& experiments) {
  double sum = 0, count = 0;
  for (const Experiment& experiment : experiments) {
    sum += experiment.signals.at(name).sum();
    count += experiment.samples();
  }
  return sum / count;
}

/// explain() describes a hum by the amplitudes of cosine and sine.
void addHum(const HumTruth& hum, Values* values) {
  if (hum.per_experiment) {  // their standard deviation over the random phases
    (*values)["sens_hum.deviation"] = hum.amplitude / std::sqrt(2.0);
  } else {
    (*values)["sens_hum.cosine"] = hum.amplitude * std::sin(hum.phase);
    (*values)["sens_hum.sine"] = hum.amplitude * std::cos(hum.phase);
  }
}

/// Replaces the parameters that explain() states in another form than the truth.
void restate(const EffectsTruth& effects, const std::vector<Experiment>& training, Values* values) {
  if (const auto& bias = effects.sensor.bias)
    values->erase(bias->per_experiment ? "sens_bias.bias" : "sens_bias.deviation");
  if (const auto& drift = effects.sensor.drift)
    values->erase(drift->per_experiment ? "sens_drift.drift" : "sens_drift.deviation");
  if (const auto& hum = effects.sensor.hum) addHum(*hum, values);
  if (const auto& temp = effects.plant.temp) {
    // The truth's gain is 1 at the reference, that of explain() at the mean temperature.
    const double away = (meanOf("temp", training) - temp->reference) / 10;
    (*values)["plant_temp.slope"] = temp->coefficient / (1 + temp->coefficient * away);
  }
  if (const auto& spread = effects.plant.parameter_spread) {
    values->erase("plant_parameter_spread.deviation");
    (*values)["plant_parameter_spread (" + spread->parameter + ").deviation"] = spread->deviation;
  }
}

}  // namespace

Values reportedParameters(const Truth& truth, const std::vector<Experiment>& training) {
  Values values;
  EffectsTruth effects = truth.effects;
  effects.forEach([&](const std::string& name, auto& effect) {
    if (effect) addFields(name, effect->fields(), truth.sample_time, &values);
  });
  restate(effects, training, &values);
  for (auto entry = values.begin(); entry != values.end();)
    entry = entry->second == 0 ? values.erase(entry) : std::next(entry);
  return values;
}

std::optional<double> valueOf(const Values& reported, const std::string& effect,
                              const std::string& variant, const std::string& parameter) {
  for (const std::string& name : {effect, effect + " (" + variant + ")"}) {
    const auto value = reported.find(name + "." + parameter);
    if (value != reported.end()) return value->second;
  }
  return std::nullopt;
}

}  // namespace uncertainty_identification::suite
