#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "uncertainty_identification/bounds/plant_distribution.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// Multiplicative uncertainty for robust control: G = Go (1 + W Delta), |Delta| <= 1, holds a share
/// `level` of the plants at all frequencies at once. W is stable and minimum phase.
struct UncertaintyWeight {
  double level = 0;       ///< asked for
  double level_held = 0;  ///< share of the drawn plants that W covers at all check frequencies
  int order = 0;
  Eigen::VectorXd num, den;  ///< W(z) = sum num_k z^-k / sum den_k z^-k, den_0 = 1
  /// The Tustin twin, z = (1 + s Ts/2)/(1 - s Ts/2), in descending powers of s: it has at the
  /// frequency 2/Ts tan(omega Ts/2) the response that W(z) has at omega.
  Eigen::VectorXd continuous_num, continuous_den;
  Eigen::VectorXd omega;  ///< [rad/s] the stated grid
  Eigen::VectorXd bound;  ///< of |G/Go - 1| there, simultaneous at `level`
  double floor = 0;       ///< the bound counts as at least this: 1e-3 of its peak
  double over_bounding_median = 0,
         over_bounding_max = 0;  ///< |W|/bound on the grid above the floor
  int check_frequencies = 0;
  double margin = 0;  ///< smallest |W|/bound over the check frequencies; at least 1
};

/// Designs W on the grid `omega` [rad/s] and lifts it until it covers the bound at 10,000
/// frequencies, by the errors of the estimate and the mixture together (of the mixture alone where
/// the former are not known). Throws DataError when the plants do not differ, or beyond measure.
UncertaintyWeight uncertaintyWeight(const PlantDistribution& plants, const Eigen::VectorXd& omega,
                                    const BoundsOptions& options, std::uint64_t seed);

/// |W| at omega [rad/s].
Eigen::ArrayXd magnitudeOf(const UncertaintyWeight& weight, const Eigen::VectorXd& omega,
                           double sample_time);

}  // namespace uncertainty_identification
