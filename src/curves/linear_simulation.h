#pragma once

#include <optional>

#include "curves/free_simulation.h"

namespace uncertainty_identification {

/// What simulateFreely() returns for a model without curves, at a fraction of the cost: by filters
/// of whole signals. Absent where the plant diverges, so that its state would have to be held.
std::optional<FreeSimulation> simulateLinearly(const CurveModel& model,
                                               const SimulationWindow& window,
                                               const Eigen::VectorXd& initial,
                                               bool with_derivatives);

}  // namespace uncertainty_identification
