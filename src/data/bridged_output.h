#pragma once

#include <Eigen/Core>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// The output with its gaps bridged by linear interpolation, for starts that need every sample.
Eigen::VectorXd bridgedOutput(const Experiment& experiment);

}  // namespace uncertainty_identification
