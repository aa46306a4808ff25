#pragma once

#include <Eigen/Core>

#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// Unbounded coordinates of a plant B/A that do not depend on how the nominal model is
/// parametrised: [b; z], where every z gives a stable A (fromUnbounded() of math/polynomial.h).
/// Throws std::domain_error for an unstable A.
Eigen::VectorXd plantCoordinates(const Eigen::VectorXd& b, const Eigen::VectorXd& a);

/// d(plant coordinates)/d(unbounded coordinates of the nominal model), (nb + na) x p.
Eigen::MatrixXd plantCoordinatesJacobian(const NominalModel& nominal, const Eigen::VectorXd& theta);

}  // namespace uncertainty_identification
