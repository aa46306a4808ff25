#pragma once

#include <Eigen/Core>

namespace uncertainty_identification {

/// The signal `samples` later, or earlier where negative; between samples by Hermite's cubic. It
/// keeps its first value before it begins and its last after it ends.
Eigen::VectorXd delayedOutput(const Eigen::VectorXd& y, double samples);

/// (1 + lead s) / (1 + lag s) applied to a signal that is linear between its samples and has had
/// its first value for ever; time constants in samples, not negative.
Eigen::VectorXd leadLag(const Eigen::VectorXd& y, double lead, double lag);

}  // namespace uncertainty_identification
