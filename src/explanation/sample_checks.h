#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/effects/effect.h"
#include "uncertainty_identification/explanation/explanation.h"

/// Checks of the samples for defects of the sensor that show without a model: a measurement with
/// continuous noise never repeats a value exactly.
namespace uncertainty_identification {

/// A defect of the sensor that spoils samples.
struct SpoiltSamples {
  Trait trait;  ///< of the effect: quantisation, output_limit, held_samples or outliers
  std::vector<CauseParameter> parameters;
  double resolution = 0;  ///< [unit of y] of a sensor that holds samples in gaps; 0: anywhere
};

/// A parameter that is counted, not estimated.
CauseParameter exactly(const std::string& name, const std::string& unit, double value);

/// The experiments from just before the first change of input or output on. A recording of a system
/// at rest repeats values though its sensor neither hangs nor is at a limit; the last three samples
/// stay, as they show where it rested.
std::vector<Experiment> withoutRest(std::vector<Experiment> experiments);

/// The defects found: quantisation, clipping and held samples. Beside quantisation, samples are
/// held in gaps only; of its values, any may be the lowest or the highest.
std::vector<SpoiltSamples> checkSamples(const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
