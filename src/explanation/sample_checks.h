#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// Evidence in the samples themselves, which needs no model: a measurement with continuous noise
/// never repeats a value exactly.
struct SpoiltSamples {
  std::string name;  ///< sens_quant, sens_clip or sens_dropout
  std::vector<CauseParameter> parameters;
};

/// The experiments without the outputs before each first moves: a system at rest has no noise, and
/// its sensor neither hangs nor is at its limit.
std::vector<Experiment> withoutRest(std::vector<Experiment> experiments);

/// At most one lattice, or clipping and held samples.
std::vector<SpoiltSamples> checkSamples(const std::vector<Experiment>& experiments);

/// The experiments without the samples that a signature spoils: clipped ones lie at the extremes of
/// `reference`, held ones repeat the one before.
std::vector<Experiment> withoutSpoiled(std::vector<Experiment> experiments,
                                       const SpoiltSamples& signature);

}  // namespace uncertainty_identification
