#pragma once

#include <Eigen/Core>

#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// Angular frequencies [rad/s], ascending, for looking at a plant: from a tenth of its slowest
/// pole's corner (at most a thousandth of the Nyquist frequency) to the Nyquist frequency, evenly
/// spaced in logarithm; a part of them lies around lightly damped poles and zeros, as dense there
/// as the resonance is narrow. Throws ConfigurationError for fewer than 10.
Eigen::VectorXd frequencyGrid(const NominalModelEstimate& plant, int count);

}  // namespace uncertainty_identification
