#pragma once

#include "simulation/simulate.h"
#include "simulation/truth.h"

/// The keys of a truth, each stated once; config/truth_reference.yaml explains them.
namespace uncertainty_identification {

class Archive;

void bind(Archive& archive, Truth& truth);
void bind(Archive& archive, EffectDraws& draws);

}  // namespace uncertainty_identification
