#pragma once

#include "uncertainty_identification/bounds/bands.h"
#include "uncertainty_identification/data/rejected_experiment.h"
#include "uncertainty_identification/enum_names.h"
#include "uncertainty_identification/estimation/estimate.h"

/// Keys of what several parts of a result hold.
namespace uncertainty_identification {

const EnumNames<Termination>& enumNames(Termination);

template <class Archive>
void bindScalar(Archive& archive, ParameterEstimate& parameter) {
  archive("unit", parameter.unit);
  archive("value", parameter.value);
  archive("standard_error", parameter.standard_error);
  archive("robust_standard_error", parameter.robust_standard_error);
}

template <class Archive>
void bind(Archive& archive, ParameterEstimate& parameter) {
  archive("name", parameter.name);
  bindScalar(archive, parameter);
}

template <class Archive>
void bind(Archive& archive, Band& band) {
  archive("level", band.level);
  archive("lower", band.lower);
  archive("upper", band.upper);
}

template <class Archive>
void bind(Archive& archive, Bands& bands) {
  archive("pointwise", bands.pointwise);
  archive("simultaneous", bands.simultaneous);
  archive("monte_carlo_error", bands.monte_carlo_error);
}

}  // namespace uncertainty_identification
