#pragma once

#include <Eigen/Core>

#include "estimation/observed_information.h"

/// Information matrices without second derivatives, under the assumption that it is known which
/// component each experiment belongs to. They are positive semidefinite everywhere, also away from
/// a maximum and for a single experiment.
namespace uncertainty_identification {

/// Gauss-Newton information about the model's parameters, in their unbounded coordinates (p x p).
/// It leaves out what the spread of xi tells about these parameters. `of_point` is the E-step at
/// the point. At most one sweep.
Eigen::MatrixXd expectedModelInformation(const Likelihood& likelihood,
                                         const Parametrisation& parametrisation,
                                         const ScoredPoint& point, const Expectation& of_point);

/// Expected information about each coordinate of the mixture if all others were known.
Eigen::VectorXd expectedMixtureInformation(const Parametrisation& parametrisation,
                                           const ScoredPoint& point, const Expectation& of_point);

}  // namespace uncertainty_identification
