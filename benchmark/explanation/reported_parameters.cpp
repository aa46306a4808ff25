#include "reported_parameters.h"

#include <cmath>

namespace uncertainty_identification::suite {
namespace {

using Values = std::map<std::string, double>;

void addActuator(const ActuatorEffects& effects, double sample_time, Values* values) {
  Values& v = *values;
  if (effects.offset) v["act_offset.offset"] = effects.offset->offset;
  if (effects.delay) v["act_delay.delay"] = effects.delay->delay;
  if (effects.quantisation) v["act_quantisation.step"] = effects.quantisation->step;
  if (effects.deadzone) v["act_deadzone.width"] = effects.deadzone->width;
  if (effects.backlash) v["act_backlash.width"] = effects.backlash->width;
  if (effects.ratelimit) v["act_ratelimit.rate"] = effects.ratelimit->rate;
  if (effects.saturation) v["act_saturation.limit"] = effects.saturation->limit;
  if (effects.hammerstein) {
    v["act_hammerstein.c2"] = effects.hammerstein->quadratic;
    v["act_hammerstein.c3"] = effects.hammerstein->cubic;
  }
  if (effects.loss) {
    v["act_loss.share"] = effects.loss->loss;
    v["act_loss.time"] = effects.loss->start * sample_time;
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

void addPlant(const PlantEffects& effects, double sample_time,
              const std::vector<Experiment>& training, Values* values) {
  Values& v = *values;
  if (effects.pole) v["plant_pole.pole"] = effects.pole->pole;
  if (const auto& mode = effects.resonance) {
    v["plant_resonance.radius"] = mode->radius;
    v["plant_resonance.frequency"] = mode->frequency / sample_time;
    v["plant_resonance.g1"] = mode->g1;
    v["plant_resonance.g2"] = mode->g2;
  }
  if (effects.cubic) v["plant_cubic.stiffness"] = effects.cubic->coefficient;
  if (effects.coulomb) {
    v["plant_coulomb.friction"] = effects.coulomb->friction;
    v["plant_coulomb.width"] = effects.coulomb->smoothing;
  }
  if (effects.drift) v["plant_drift.slope"] = effects.drift->slope;
  if (effects.aging) {
    for (int i = 0; i < effects.aging->shift.size(); ++i)
      v["plant_aging.shift" + std::to_string(i + 1)] = effects.aging->shift(i);
  }
  if (const auto& temp = effects.temp) {  // the gain is 1 at the mean there, at the reference here
    const double away = (meanOf("temp", training) - temp->reference) / 10;
    v["plant_temp.slope"] = temp->coefficient / (1 + temp->coefficient * away);
  }
  if (effects.init) v["plant_init.deviation"] = effects.init->deviation;
}

void addSensor(const SensorEffects& effects, double sample_time, Values* values) {
  Values& v = *values;
  if (effects.wiener) {
    v["sens_wiener.c2"] = effects.wiener->quadratic;
    v["sens_wiener.c3"] = effects.wiener->cubic;
  }
  if (const auto& bias = effects.bias) {
    if (bias->per_experiment) v["sens_bias.deviation"] = bias->deviation;
    if (!bias->per_experiment) v["sens_bias.bias"] = bias->bias;
  }
  if (const auto& drift = effects.drift) {
    if (drift->per_experiment) v["sens_drift.deviation"] = drift->deviation;
    if (!drift->per_experiment) v["sens_drift.drift"] = drift->drift;
  }
  if (const auto& hum = effects.hum) {
    v["sens_hum.frequency"] = hum->frequency / sample_time;
    if (hum->per_experiment) {  // of the coefficients of cosine and sine
      v["sens_hum.deviation"] = hum->amplitude / std::sqrt(2.0);
    } else {
      v["sens_hum.cosine"] = hum->amplitude * std::sin(hum->phase);
      v["sens_hum.sine"] = hum->amplitude * std::cos(hum->phase);
    }
  }
  if (effects.lag) v["sens_lag.pole"] = effects.lag->pole;
  if (effects.clip) v["sens_clip.limit"] = effects.clip->limit;
  if (effects.quant) v["sens_quant.step"] = effects.quant->step;
}

void addNoise(const NoiseEffects& effects, double sample_time, Values* values) {
  Values& v = *values;
  if (effects.colour) {
    v["noise_colour.d1"] = effects.colour->d1;
    v["noise_colour.d2"] = effects.colour->d2;
  }
  if (effects.tails) v["noise_tails.degrees_of_freedom"] = effects.tails->degrees_of_freedom;
  if (effects.hetero) v["noise_hetero.share"] = effects.hetero->share;
  if (effects.step) {
    v["noise_step.ratio"] = effects.step->ratio;
    v["noise_step.time"] = effects.step->start * sample_time;
  }
}

void addExperiment(const ExperimentEffects& effects, Values* values) {
  Values& v = *values;
  if (effects.input2) {
    v["exp_input2.gain"] = effects.input2->gain;
    v["exp_input2.pole"] = effects.input2->pole;
  }
  if (effects.clock) v["exp_clock.deviation"] = effects.clock->deviation;
  if (effects.jitter) v["exp_jitter.share"] = effects.jitter->coupling;
}

}  // namespace

Values reportedParameters(const Truth& truth, const std::vector<Experiment>& training) {
  Values values;
  addActuator(truth.effects.actuator, truth.sample_time, &values);
  addPlant(truth.effects.plant, truth.sample_time, training, &values);
  addSensor(truth.effects.sensor, truth.sample_time, &values);
  addNoise(truth.effects.noise, truth.sample_time, &values);
  addExperiment(truth.effects.experiment, &values);
  if (const auto& spread = truth.effects.plant.parameter_spread)
    values["plant_parameter_spread (" + spread->parameter + ").deviation"] = spread->deviation;
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
