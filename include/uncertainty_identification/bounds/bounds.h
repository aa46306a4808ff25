#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "uncertainty_identification/bounds/complex_region.h"
#include "uncertainty_identification/bounds/prediction_calibration.h"
#include "uncertainty_identification/bounds/uncertainty_bounds.h"
#include "uncertainty_identification/bounds/uncertainty_weight.h"

namespace uncertainty_identification {

/// How sure an identified model is: everything of configuration.bounds in one value.
struct Bounds {
  std::vector<double> levels;
  int samples = 0;         ///< plants drawn
  std::uint64_t seed = 0;  ///< they were drawn with
  FrequencyBounds frequency;
  StepBounds step;
  std::vector<ComplexRegion> regions;               ///< at some of the frequencies
  std::optional<UncertaintyWeight> weight;          ///< none where the plants do not differ
  std::optional<PredictionCalibration> prediction;  ///< where Identifier::calibrate() was asked
  std::vector<std::string> warnings;
  double seconds = 0;  ///< [s] wall time that computing them took
};

/// Bounds of an estimate, by its own configuration.bounds and seed. Throws DataError when the
/// nominal model is not stable, ConfigurationError for a grid above the Nyquist frequency.
Bounds computeBounds(const Estimate& estimate);

}  // namespace uncertainty_identification
