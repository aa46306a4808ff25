#pragma once

#include "io/tree_values.h"
#include "simulation/effects_truth.h"

/// The keys of the effects that a truth hides, each stated once; config/truth_reference.yaml
/// explains them.
namespace uncertainty_identification {

template <class Archive>
void bind(Archive& archive, ActuatorOffsetTruth& effect) {
  archive("offset", effect.offset);
}

template <class Archive>
void bind(Archive& archive, ActuatorDelayTruth& effect) {
  archive("delay", effect.delay);
}

template <class Archive>
void bind(Archive& archive, ActuatorQuantisationTruth& effect) {
  archive("step", effect.step);
}

template <class Archive>
void bind(Archive& archive, DeadZoneTruth& effect) {
  archive("width", effect.width);
  archive("negative_width", effect.negative_width);
}

template <class Archive>
void bind(Archive& archive, BacklashTruth& effect) {
  archive("width", effect.width);
}

template <class Archive>
void bind(Archive& archive, RateLimitTruth& effect) {
  archive("rate", effect.rate);
}

template <class Archive>
void bind(Archive& archive, SaturationTruth& effect) {
  archive("limit", effect.limit);
}

template <class Archive>
void bind(Archive& archive, HammersteinTruth& effect) {
  archive("quadratic", effect.quadratic);
  archive("cubic", effect.cubic);
}

template <class Archive>
void bind(Archive& archive, LossTruth& effect) {
  archive("loss", effect.loss);
  archive("start", effect.start);
}

template <class Archive>
void bind(Archive& archive, PlantPoleTruth& effect) {
  archive("pole", effect.pole);
}

template <class Archive>
void bind(Archive& archive, ResonanceTruth& effect) {
  archive("radius", effect.radius);
  archive("frequency", effect.frequency);
  archive("g1", effect.g1);
  archive("g2", effect.g2);
}

template <class Archive>
void bind(Archive& archive, CubicTruth& effect) {
  archive("coefficient", effect.coefficient);
}

template <class Archive>
void bind(Archive& archive, CoulombTruth& effect) {
  archive("friction", effect.friction);
  archive("smoothing", effect.smoothing);
}

template <class Archive>
void bind(Archive& archive, GainDriftTruth& effect) {
  archive("slope", effect.slope);
}

template <class Archive>
void bind(Archive& archive, AgingTruth& effect) {
  archive("shift", effect.shift);
}

template <class Archive>
void bind(Archive& archive, TemperatureGainTruth& effect) {
  archive("coefficient", effect.coefficient);
  archive("reference", effect.reference);
}

template <class Archive>
void bind(Archive& archive, InitialStateTruth& effect) {
  archive("deviation", effect.deviation);
}

template <class Archive>
void bind(Archive& archive, ParameterSpreadTruth& effect) {
  archive("parameter", effect.parameter);
  archive("deviation", effect.deviation);
}

template <class Archive>
void bind(Archive& archive, WienerTruth& effect) {
  archive("quadratic", effect.quadratic);
  archive("cubic", effect.cubic);
}

template <class Archive>
void bind(Archive& archive, BiasTruth& effect) {
  archive("bias", effect.bias);
  archive("per_experiment", effect.per_experiment);
  archive("deviation", effect.deviation);
}

template <class Archive>
void bind(Archive& archive, SensorDriftTruth& effect) {
  archive("drift", effect.drift);
  archive("per_experiment", effect.per_experiment);
  archive("deviation", effect.deviation);
}

template <class Archive>
void bind(Archive& archive, HumTruth& effect) {
  archive("amplitude", effect.amplitude);
  archive("frequency", effect.frequency);
  archive("phase", effect.phase);
  archive("per_experiment", effect.per_experiment);
}

template <class Archive>
void bind(Archive& archive, SensorLagTruth& effect) {
  archive("pole", effect.pole);
}

template <class Archive>
void bind(Archive& archive, OutliersTruth& effect) {
  archive("probability", effect.probability);
  archive("size", effect.size);
}

template <class Archive>
void bind(Archive& archive, ClipTruth& effect) {
  archive("limit", effect.limit);
  archive("before_noise", effect.before_noise);
}

template <class Archive>
void bind(Archive& archive, SensorQuantisationTruth& effect) {
  archive("step", effect.step);
}

template <class Archive>
void bind(Archive& archive, DropoutTruth& effect) {
  archive("probability", effect.probability);
}

template <class Archive>
void bind(Archive& archive, ColourTruth& effect) {
  archive("d1", effect.d1);
  archive("d2", effect.d2);
}

template <class Archive>
void bind(Archive& archive, TailsTruth& effect) {
  archive("degrees_of_freedom", effect.degrees_of_freedom);
}

template <class Archive>
void bind(Archive& archive, HeteroTruth& effect) {
  archive("share", effect.share);
  archive("driver", effect.driver);
  archive("scale", effect.scale);
}

template <class Archive>
void bind(Archive& archive, NoiseStepTruth& effect) {
  archive("ratio", effect.ratio);
  archive("start", effect.start);
}

template <class Archive>
void bind(Archive& archive, FeedbackTruth& effect) {
  archive("gain", effect.gain);
}

template <class Archive>
void bind(Archive& archive, ModeTruth& effect) {
  archive("weight", effect.weight);
  archive("mean", effect.mean);
  archive("deviation", effect.deviation);
}

template <class Archive>
void bind(Archive& archive, SecondInputTruth& effect) {
  archive("gain", effect.gain);
  archive("pole", effect.pole);
}

template <class Archive>
void bind(Archive& archive, ClockTruth& effect) {
  archive("deviation", effect.deviation);
}

template <class Archive>
void bind(Archive& archive, JitterTruth& effect) {
  archive("width", effect.width);
  archive("coupling", effect.coupling);
}

template <class Archive>
void bind(Archive& archive, TelegraphTruth& effect) {
  archive("depth", effect.depth);
  archive("probability", effect.probability);
}

template <class Archive>
void bind(Archive& archive, BilinearTruth& effect) {
  archive("coefficient", effect.coefficient);
}

template <class Archive>
void bind(Archive& archive, GravityTruth& effect) {
  archive("torque", effect.torque);
  archive("angle", effect.angle);
}

template <class Archive>
void bind(Archive& archive, OutflowTruth& effect) {
  archive("coefficient", effect.coefficient);
}

template <class Archive>
void bind(Archive& archive, RectificationTruth& effect) {
  archive("share", effect.share);
}

template <class Archive>
void bind(Archive& archive, BurstTruth& effect) {
  archive("amplitude", effect.amplitude);
  archive("probability", effect.probability);
  archive("frequency", effect.frequency);
  archive("radius", effect.radius);
}

template <class Archive>
void bind(Archive& archive, EffectsTruth& effects) {
  archive("act_offset", whenPresent(effects.actuator.offset));
  archive("act_delay", whenPresent(effects.actuator.delay));
  archive("act_quantisation", whenPresent(effects.actuator.quantisation));
  archive("act_deadzone", whenPresent(effects.actuator.deadzone));
  archive("act_backlash", whenPresent(effects.actuator.backlash));
  archive("act_ratelimit", whenPresent(effects.actuator.ratelimit));
  archive("act_saturation", whenPresent(effects.actuator.saturation));
  archive("act_hammerstein", whenPresent(effects.actuator.hammerstein));
  archive("act_loss", whenPresent(effects.actuator.loss));
  archive("plant_pole", whenPresent(effects.plant.pole));
  archive("plant_resonance", whenPresent(effects.plant.resonance));
  archive("plant_cubic", whenPresent(effects.plant.cubic));
  archive("plant_coulomb", whenPresent(effects.plant.coulomb));
  archive("plant_drift", whenPresent(effects.plant.drift));
  archive("plant_aging", whenPresent(effects.plant.aging));
  archive("plant_temp", whenPresent(effects.plant.temp));
  archive("plant_init", whenPresent(effects.plant.init));
  archive("plant_parameter_spread", whenPresent(effects.plant.parameter_spread));
  archive("sens_wiener", whenPresent(effects.sensor.wiener));
  archive("sens_bias", whenPresent(effects.sensor.bias));
  archive("sens_drift", whenPresent(effects.sensor.drift));
  archive("sens_hum", whenPresent(effects.sensor.hum));
  archive("sens_lag", whenPresent(effects.sensor.lag));
  archive("sens_outliers", whenPresent(effects.sensor.outliers));
  archive("sens_clip", whenPresent(effects.sensor.clip));
  archive("sens_quant", whenPresent(effects.sensor.quant));
  archive("sens_dropout", whenPresent(effects.sensor.dropout));
  archive("noise_colour", whenPresent(effects.noise.colour));
  archive("noise_tails", whenPresent(effects.noise.tails));
  archive("noise_hetero", whenPresent(effects.noise.hetero));
  archive("noise_step", whenPresent(effects.noise.step));
  archive("exp_feedback", whenPresent(effects.experiment.feedback));
  archive("exp_mode", whenPresent(effects.experiment.mode));
  archive("exp_input2", whenPresent(effects.experiment.input2));
  archive("exp_clock", whenPresent(effects.experiment.clock));
  archive("exp_jitter", whenPresent(effects.experiment.jitter));
  archive("unk_telegraph", whenPresent(effects.unnamed.telegraph));
  archive("unk_bilinear", whenPresent(effects.unnamed.bilinear));
  archive("unk_gravity", whenPresent(effects.unnamed.gravity));
  archive("unk_outflow", whenPresent(effects.unnamed.outflow));
  archive("unk_rectification", whenPresent(effects.unnamed.rectification));
  archive("unk_burst", whenPresent(effects.unnamed.burst));
}

}  // namespace uncertainty_identification
