#pragma once

#include <Eigen/Core>

#include "uncertainty_identification/data/recording.h"

namespace uncertainty_identification {

/// The signal at start, start + period, ..., `count` times: its newest value, or the first one
/// before it has any. The stamps rise.
Eigen::VectorXd heldSignal(const StampedSignal& signal, double start, double period,
                           Eigen::Index count);

}  // namespace uncertainty_identification
