#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "uncertainty_identification/bounds/plant_distribution.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// Multiplicative uncertainty for robust control: G = Go (1 + W Delta), |Delta| <= 1, contains a
/// share `level` of the plants at all frequencies simultaneously. W is stable and minimum phase.
struct UncertaintyWeight {
  double level = 0;       ///< the share asked for
  double level_held = 0;  ///< share of the drawn plants that W covers at all check frequencies
  int order = 0;
  Eigen::VectorXd num, den;  ///< W(z) = sum num_k z^-k / sum den_k z^-k, den_0 = 1
  /// W in continuous time by Tustin's substitution, z = (1 + s Ts/2)/(1 - s Ts/2), in descending
  /// powers of s. Its response at the frequency 2/Ts tan(omega Ts/2) equals that of W(z) at omega.
  Eigen::VectorXd continuous_num, continuous_den;
  Eigen::VectorXd omega;  ///< [rad/s] the grid of `bound`
  Eigen::VectorXd bound;  ///< bound of |G/Go - 1| on the grid, simultaneous at `level`
  double floor = 0;       ///< smaller values of the bound are raised to this: 1e-3 of its peak
  double over_bounding_median = 0,
         over_bounding_max = 0;  ///< |W|/bound on the grid above the floor
  int check_frequencies = 0;
  double margin = 0;  ///< smallest |W|/bound over the check frequencies, at least 1
};

/// Designs W on the grid `omega` [rad/s] and scales it up until it covers the bound at 10,000
/// frequencies. The bound includes the estimation errors where these are known. Throws DataError
/// when the plants do not differ, or when the bound is not finite.
UncertaintyWeight uncertaintyWeight(const PlantDistribution& plants, const Eigen::VectorXd& omega,
                                    const BoundsOptions& options, std::uint64_t seed);

/// |W| at omega [rad/s].
Eigen::ArrayXd magnitudeOf(const UncertaintyWeight& weight, const Eigen::VectorXd& omega,
                           double sample_time);

}  // namespace uncertainty_identification
