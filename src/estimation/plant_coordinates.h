#pragma once

#include <Eigen/Core>

#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// Unbounded coordinates of a plant B/A that need no parametrisation: [b; z], where any z gives a
/// stable A (fromUnbounded() of polynomial.h). Throws std::domain_error for an unstable A.
Eigen::VectorXd plantCoordinates(const Eigen::VectorXd& b, const Eigen::VectorXd& a);

/// d(plant coordinates)/d(unbounded coordinates of the nominal model), (nb + na) x p.
Eigen::MatrixXd plantCoordinatesJacobian(const NominalModel& nominal, const Eigen::VectorXd& theta);

}  // namespace uncertainty_identification
