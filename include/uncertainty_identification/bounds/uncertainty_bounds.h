#pragma once

#include <Eigen/Core>
#include <optional>

#include "uncertainty_identification/bounds/bands.h"
#include "uncertainty_identification/bounds/plant_distribution.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// The bands of one quantity: from the mixture alone, and with the estimation errors included
/// (empty where these are not known).
struct UncertaintyBands {
  Bands mixture, total;
};

/// Bands of the response of G = Go (1 + GDelta) over frequency.
struct FrequencyBounds {
  Eigen::VectorXd omega;             ///< [rad/s]
  Eigen::VectorXd magnitude;         ///< |Go| [unit of y / unit of u]
  Eigen::VectorXd phase;             ///< of Go, unwrapped, the delay included [rad]
  UncertaintyBands magnitude_bands;  ///< [unit of y / unit of u]
  UncertaintyBands phase_bands;      ///< [rad]; a plant's phase is taken within half a turn of Go's
  UncertaintyBands
      relative_error;  ///< |G/Go - 1|, the multiplicative uncertainty; upper limit only
  /// [rad/s] The first frequency of the grid from which on the plant may as well be zero for all
  /// that the data show (StructureError, with 95 %). Absent: there is none.
  std::optional<double> hidden_from;
};

/// Bands of the response to a unit step.
struct StepBounds {
  Eigen::VectorXd time;     ///< [s]
  Eigen::VectorXd nominal;  ///< [unit of y / unit of u]
  UncertaintyBands bands;
};

/// Throws ConfigurationError for a grid that exceeds the Nyquist frequency. The same estimate,
/// options and seed give the same bounds.
FrequencyBounds frequencyBounds(const PlantDistribution& plants, const Eigen::VectorXd& omega,
                                const BoundsOptions& options, std::uint64_t seed);

StepBounds stepBounds(const PlantDistribution& plants, const BoundsOptions& options,
                      std::uint64_t seed);

}  // namespace uncertainty_identification
