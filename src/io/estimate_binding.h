#pragma once

#include "uncertainty_identification/bounds/bands.h"
#include "uncertainty_identification/enum_names.h"
#include "uncertainty_identification/estimation/estimate.h"

/// The keys of an estimate and of what several parts of a result hold.
namespace uncertainty_identification {

class Archive;

const EnumNames<Termination>& enumNames(Termination);

void bind(Archive& archive, Trust& trust);
void bind(Archive& archive, Estimate& estimate);
void bind(Archive& archive, ParameterEstimate& parameter);
void bind(Archive& archive, Bands& bands);

}  // namespace uncertainty_identification
