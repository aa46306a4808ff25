#pragma once

#include "own_simulation/shaped_simulation.h"
#include "uncertainty_identification/curves/simulation_causes.h"

namespace uncertainty_identification {

/// The cause's name, place and shape.
PlaceAndShape placeAndShapeOf(const PlacedShape& placed);

/// A shape around a simulation as a cause, in the units of the data: `parameters` as
/// ShapedSimulation has them, with their covariance; the curve is drawn between `low` and `high`.
SimulationCause describeShape(const PlacedShape& placed, const Eigen::VectorXd& parameters,
                              const Eigen::MatrixXd& covariance, double low, double high);

}  // namespace uncertainty_identification
