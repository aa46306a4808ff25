#include "simulation/effects_truth.h"

#include <cmath>

#include "math/polynomial.h"
#include "simulation/require_number.h"

namespace uncertainty_identification {
namespace {

const double kPi = std::acos(-1.0);

void requireRadius(const std::string& key, double radius) {
  require(radius >= 0 && radius < 1, key, radius, "at least 0 and below 1");
}

void requireFrequency(const std::string& key, double frequency) {
  requireRange(key, frequency, 0.0, kPi);
}

}  // namespace

const EnumNames<HeteroDriver>& enumNames(HeteroDriver) {
  static const EnumNames<HeteroDriver> kNames{{HeteroDriver::input, "u"},
                                              {HeteroDriver::output, "x"}};
  return kNames;
}

void PlantEffects::validate() const {
  if (pole) requireInsideCircle("effects.plant_pole.pole", pole->pole);
  if (resonance) {
    requireRadius("effects.plant_resonance.radius", resonance->radius);
    requireFrequency("effects.plant_resonance.frequency", resonance->frequency);
    requireFinite("effects.plant_resonance.g1", resonance->g1);
    requireFinite("effects.plant_resonance.g2", resonance->g2);
  }
  if (cubic) requireFinite("effects.plant_cubic.coefficient", cubic->coefficient);
  if (coulomb) {
    requireNotNegative("effects.plant_coulomb.friction", coulomb->friction);
    requirePositive("effects.plant_coulomb.smoothing", coulomb->smoothing);
  }
  if (drift) requireFinite("effects.plant_drift.slope", drift->slope);
  if (aging) {
    require(aging->shift.allFinite(), "effects.plant_aging.shift", aging->shift.transpose(),
            "finite numbers");
  }
  if (temp) {
    requireFinite("effects.plant_temp.coefficient", temp->coefficient);
    requireFinite("effects.plant_temp.reference", temp->reference);
  }
  if (init) requireNotNegative("effects.plant_init.deviation", init->deviation);
  if (parameter_spread)
    requireNotNegative("effects.plant_parameter_spread.deviation", parameter_spread->deviation);
}

void SensorEffects::validate() const {
  if (wiener) {
    requireFinite("effects.sens_wiener.quadratic", wiener->quadratic);
    requireFinite("effects.sens_wiener.cubic", wiener->cubic);
  }
  if (bias) {
    requireFinite("effects.sens_bias.bias", bias->bias);
    requireNotNegative("effects.sens_bias.deviation", bias->deviation);
  }
  if (drift) {
    requireFinite("effects.sens_drift.drift", drift->drift);
    requireNotNegative("effects.sens_drift.deviation", drift->deviation);
  }
  if (hum) {
    requireNotNegative("effects.sens_hum.amplitude", hum->amplitude);
    requireFrequency("effects.sens_hum.frequency", hum->frequency);
    requireFinite("effects.sens_hum.phase", hum->phase);
  }
  if (lag) requireInsideCircle("effects.sens_lag.pole", lag->pole);
  if (outliers) {
    requireProbability("effects.sens_outliers.probability", outliers->probability);
    requireNotNegative("effects.sens_outliers.size", outliers->size);
  }
  if (clip) requirePositive("effects.sens_clip.limit", clip->limit);
  if (quant) requirePositive("effects.sens_quant.step", quant->step);
  if (dropout) requireProbability("effects.sens_dropout.probability", dropout->probability);
}

void NoiseEffects::validate() const {
  if (colour) {
    const Eigen::VectorXd d = Eigen::Vector2d(colour->d1, colour->d2);
    require(d.allFinite() && isStable(d), "effects.noise_colour", d.transpose(),
            "d1, d2 with the roots of 1 + d1 q^-1 + d2 q^-2 inside the unit circle");
  }
  if (tails) {
    require(tails->degrees_of_freedom > 2 && std::isfinite(tails->degrees_of_freedom),
            "effects.noise_tails.degrees_of_freedom", tails->degrees_of_freedom,
            "a finite number above 2");
  }
  if (hetero) {
    requireProbability("effects.noise_hetero.share", hetero->share);
    requirePositive("effects.noise_hetero.scale", hetero->scale);
  }
  if (step) {
    requirePositive("effects.noise_step.ratio", step->ratio);
    requireFinite("effects.noise_step.start", step->start);
  }
}

void ExperimentEffects::validate() const {
  if (feedback) requireFinite("effects.exp_feedback.gain", feedback->gain);
  if (mode) {
    requireProbability("effects.exp_mode.weight", mode->weight);
    require(mode->mean.allFinite(), "effects.exp_mode.mean", mode->mean.transpose(),
            "finite numbers");
    requireNotNegative("effects.exp_mode.deviation", mode->deviation);
  }
  if (input2) {
    requireFinite("effects.exp_input2.gain", input2->gain);
    requireInsideCircle("effects.exp_input2.pole", input2->pole);
  }
  if (clock) requireNotNegative("effects.exp_clock.deviation", clock->deviation);
  if (jitter) {
    require(jitter->width >= 0 && jitter->width < 0.5, "effects.exp_jitter.width", jitter->width,
            "at least 0 and below 0.5");
    requireFinite("effects.exp_jitter.coupling", jitter->coupling);
  }
}

void UnnamedEffects::validate() const {
  if (telegraph) {
    requireFinite("effects.unk_telegraph.depth", telegraph->depth);
    requireProbability("effects.unk_telegraph.probability", telegraph->probability);
  }
  if (bilinear) requireFinite("effects.unk_bilinear.coefficient", bilinear->coefficient);
  if (gravity) {
    requireFinite("effects.unk_gravity.torque", gravity->torque);
    requirePositive("effects.unk_gravity.angle", gravity->angle);
  }
  if (outflow) requireFinite("effects.unk_outflow.coefficient", outflow->coefficient);
  if (rectification) requireFinite("effects.unk_rectification.share", rectification->share);
  if (burst) {
    requireFinite("effects.unk_burst.amplitude", burst->amplitude);
    requireProbability("effects.unk_burst.probability", burst->probability);
    requireFrequency("effects.unk_burst.frequency", burst->frequency);
    requireRadius("effects.unk_burst.radius", burst->radius);
  }
}

void EffectsTruth::validate() const {
  actuator.validate();
  plant.validate();
  sensor.validate();
  noise.validate();
  experiment.validate();
  unnamed.validate();
}

}  // namespace uncertainty_identification
