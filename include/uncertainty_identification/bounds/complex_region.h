#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "uncertainty_identification/bounds/plant_distribution.h"

namespace uncertainty_identification {

/// A convex polygon of the complex plane that holds G(e^(j omega Ts)) of a share `level` of the
/// plants: the intersection of half planes in 24 directions of the responses' own metric, a
/// simultaneous band over the directions.
struct ComplexRegion {
  double omega = 0;  ///< [rad/s]
  double level = 0;
  Eigen::VectorXd real, imaginary;  ///< corners, anticlockwise [unit of y / unit of u]
};

/// The region of each level at each frequency, frequencies outermost. The errors of the estimate
/// count where they are known.
std::vector<ComplexRegion> complexRegions(const PlantDistribution& plants,
                                          const Eigen::VectorXd& omega,
                                          const BoundsOptions& options, std::uint64_t seed);

}  // namespace uncertainty_identification
