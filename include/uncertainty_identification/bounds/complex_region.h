#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "uncertainty_identification/bounds/plant_distribution.h"

namespace uncertainty_identification {

/// A convex polygon in the complex plane that contains G(e^(j omega Ts)) for a share `level` of the
/// plants. It is the intersection of half planes in 24 directions. The directions are evenly spaced
/// after the responses have been scaled to unit covariance, and the limits form a simultaneous band
/// over them.
struct ComplexRegion {
  double omega = 0;  ///< [rad/s]
  double level = 0;
  Eigen::VectorXd real, imaginary;  ///< corners, counterclockwise [unit of y / unit of u]
};

/// The region for every level at every frequency, the frequency being the outer loop. Includes the
/// estimation errors where they are known.
std::vector<ComplexRegion> complexRegions(const PlantDistribution& plants,
                                          const Eigen::VectorXd& omega,
                                          const BoundsOptions& options, std::uint64_t seed);

}  // namespace uncertainty_identification
