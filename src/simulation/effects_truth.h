#pragma once

#include "simulation/actuator_effects.h"
#include "simulation/experiment_effects.h"
#include "simulation/noise_effects.h"
#include "simulation/plant_effects.h"
#include "simulation/sensor_effects.h"
#include "simulation/unnamed_effects.h"

namespace uncertainty_identification {

/// The effects that the simulated system has and that the identified model does not know: any
/// number at once. They act in the order actuator, plant, sensor and noise, record.
struct EffectsTruth {
  ActuatorEffects actuator;
  PlantEffects plant;
  SensorEffects sensor;
  NoiseEffects noise;
  ExperimentEffects experiment;
  UnnamedEffects unnamed;

  /// Calls visit(name, effect) for every effect: `name` is its key in YAML, which is also its name
  /// in the catalogue of explain(), and `effect` is the std::optional of its struct.
  /// explanation_benchmark draws its pairs of effects by their positions in this list.
  template <class Visitor>
  void forEach(Visitor&& visit) {
    visit("act_delay", actuator.delay);
    visit("act_saturation", actuator.saturation);
    visit("act_deadzone", actuator.deadzone);
    visit("act_backlash", actuator.backlash);
    visit("act_ratelimit", actuator.ratelimit);
    visit("act_quantisation", actuator.quantisation);
    visit("act_offset", actuator.offset);
    visit("act_hammerstein", actuator.hammerstein);
    visit("act_loss", actuator.loss);
    visit("plant_pole", plant.pole);
    visit("plant_resonance", plant.resonance);
    visit("plant_cubic", plant.cubic);
    visit("plant_coulomb", plant.coulomb);
    visit("plant_drift", plant.drift);
    visit("plant_aging", plant.aging);
    visit("plant_temp", plant.temp);
    visit("plant_init", plant.init);
    visit("sens_bias", sensor.bias);
    visit("sens_drift", sensor.drift);
    visit("sens_clip", sensor.clip);
    visit("sens_quant", sensor.quant);
    visit("sens_outliers", sensor.outliers);
    visit("sens_dropout", sensor.dropout);
    visit("sens_hum", sensor.hum);
    visit("sens_wiener", sensor.wiener);
    visit("sens_lag", sensor.lag);
    visit("noise_colour", noise.colour);
    visit("noise_tails", noise.tails);
    visit("noise_hetero", noise.hetero);
    visit("noise_step", noise.step);
    visit("exp_feedback", experiment.feedback);
    visit("exp_mode", experiment.mode);
    visit("exp_input2", experiment.input2);
    visit("exp_clock", experiment.clock);
    visit("exp_jitter", experiment.jitter);
    visit("plant_parameter_spread", plant.parameter_spread);
    visit("unk_telegraph", unnamed.telegraph);
    visit("unk_bilinear", unnamed.bilinear);
    visit("unk_gravity", unnamed.gravity);
    visit("unk_outflow", unnamed.outflow);
    visit("unk_rectification", unnamed.rectification);
    visit("unk_burst", unnamed.burst);
  }

  /// Whether an effect feeds the plant's output back to the input of its linear part.
  bool feedsBack() const;

  /// Throws ConfigurationError naming key, value and allowed range.
  void validate() const;
};

}  // namespace uncertainty_identification
