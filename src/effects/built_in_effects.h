#pragma once

#include "uncertainty_identification/effects/catalogue.h"

/// The effects of the catalogue: each function makes the forms of one effect that fit the data
/// described. catalogue.cpp lists them in physical order.
namespace uncertainty_identification {

// actuator_effects.cpp
MadeEffects actuatorOffset(const DataSummary& data);
MadeEffects actuatorDelay(const DataSummary& data);
MadeEffects actuatorQuantisation(const DataSummary& data);
MadeEffects actuatorDeadZone(const DataSummary& data);
MadeEffects actuatorBacklash(const DataSummary& data);
MadeEffects actuatorRateLimit(const DataSummary& data);
MadeEffects actuatorSaturation(const DataSummary& data);
MadeEffects actuatorCurve(const DataSummary& data);
MadeEffects actuatorLoss(const DataSummary& data);

// plant_effects.cpp
MadeEffects plantDrift(const DataSummary& data);
MadeEffects plantTemperature(const DataSummary& data);
MadeEffects plantCubicStiffness(const DataSummary& data);
MadeEffects plantCoulombFriction(const DataSummary& data);
MadeEffects plantResonance(const DataSummary& data);
MadeEffects plantPole(const DataSummary& data);
MadeEffects plantAging(const DataSummary& data);
MadeEffects plantInitialState(const DataSummary& data);

// spread_effects.cpp
MadeEffects plantParameterSpread(const DataSummary& data);
MadeEffects plantTimeConstantSpread(const DataSummary& data);

// sensor_effects.cpp
MadeEffects sensorLag(const DataSummary& data);
MadeEffects sensorCurve(const DataSummary& data);
MadeEffects sensorClipping(const DataSummary& data);
MadeEffects sensorBias(const DataSummary& data);
MadeEffects sensorDrift(const DataSummary& data);
MadeEffects sensorHum(const DataSummary& data);

// noise_effects.cpp
MadeEffects noiseColour(const DataSummary& data);
MadeEffects noiseLevel(const DataSummary& data);
MadeEffects noiseStep(const DataSummary& data);

// experiment_effects.cpp
MadeEffects secondInput(const DataSummary& data);
MadeEffects samplingJitter(const DataSummary& data);
MadeEffects clockOffset(const DataSummary& data);

// outside_the_chain.cpp
MadeEffects effectsOutsideTheChain(const DataSummary& data);

}  // namespace uncertainty_identification
