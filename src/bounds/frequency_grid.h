#pragma once

#include <Eigen/Core>

#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// Angular frequencies [rad/s] at which to evaluate a plant, ascending. They reach from a tenth of
/// the corner frequency of the slowest pole (at most a thousandth of the Nyquist frequency) to the
/// Nyquist frequency, evenly spaced in the logarithm. Some of them are placed around lightly damped
/// poles and zeros, the more closely the narrower the resonance. Throws ConfigurationError for
/// fewer than 10 points.
Eigen::VectorXd frequencyGrid(const NominalModelEstimate& plant, int count);

}  // namespace uncertainty_identification
