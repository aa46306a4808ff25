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

/// The uncertainty of an identified model: everything that configuration.bounds asks for.
struct Bounds {
  std::vector<double> levels;
  int samples = 0;         ///< number of plants drawn
  std::uint64_t seed = 0;  ///< seed of these draws
  FrequencyBounds frequency;
  StepBounds step;
  std::vector<ComplexRegion> regions;               ///< at a subset of the frequencies
  std::optional<UncertaintyWeight> weight;          ///< absent where the plants do not differ
  std::optional<PredictionCalibration> prediction;  ///< only after Identifier::calibrate()
  std::vector<std::string> warnings;
  Trust trust;         ///< whether these bounds can be relied on
  double seconds = 0;  ///< [s] wall time of the computation
};

/// Computes the bounds of an estimate with the options in its configuration.bounds and its seed.
/// Throws DataError when the nominal model is not stable, ConfigurationError for a grid that
/// exceeds the Nyquist frequency.
Bounds computeBounds(const Estimate& estimate);

}  // namespace uncertainty_identification
