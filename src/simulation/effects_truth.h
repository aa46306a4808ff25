#pragma once

#include "simulation/actuator_effects.h"
#include "simulation/experiment_effects.h"
#include "simulation/noise_effects.h"
#include "simulation/plant_effects.h"
#include "simulation/sensor_effects.h"
#include "simulation/unnamed_effects.h"

namespace uncertainty_identification {

/// What a truth hides from a declared simulation: any number of effects at once, each absent or
/// with its parameters. They act in the order actuator, plant, sensor, noise, record, within a
/// group in the order of declaration. The YAML key of an effect is its name in the catalogue, e.g.
/// act_delay.
struct EffectsTruth {
  ActuatorEffects actuator;      ///< act_*
  PlantEffects plant;            ///< plant_*
  SensorEffects sensor;          ///< sens_*
  NoiseEffects noise;            ///< noise_*
  ExperimentEffects experiment;  ///< exp_*
  UnnamedEffects unnamed;        ///< unk_*: in no catalogue

  void validate() const;
};

}  // namespace uncertainty_identification
