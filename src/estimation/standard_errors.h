#pragma once

#include <string>
#include <vector>

#include "estimation/observed_information.h"

namespace uncertainty_identification {

/// Covariances of all natural coordinates [parameters; weights; means; covariances; sigma^2] at a
/// maximum of the likelihood.
///
/// WARNING: these describe the error of the estimate for many experiments, if the model is true
/// (observed) or for its best approximation (robust). They do not describe the spread of the plant;
/// the mixture does. If the information is singular, the coordinates concerned are NaN, and
/// `singular` names those that the data cannot tell apart.
struct StandardErrors {
  Eigen::MatrixXd covariance;  ///< J H^-1 J', H the observed information
  Eigen::MatrixXd
      robust_covariance;  ///< sandwich J H^-1 (sum of score score') H^-1 J'; NaN if M is too small
  /// Covariance in the unbounded coordinates. Singular directions are left out instead.
  Eigen::MatrixXd coordinate_covariance;
  Eigen::MatrixXd robust_coordinate_covariance;
  std::vector<std::string> singular;  ///< sentences that name the parameters
};

/// Needs two sweeps per model parameter. `scores`, if not empty, are those of independent parts of
/// the data, a column each, with respect to [parameters; log sigma^2] of a model without
/// regressors: they take the place of the experiments' own where these are too few for the
/// sandwich.
StandardErrors standardErrors(const Likelihood& likelihood, const Parametrisation& parametrisation,
                              const ModelParameters& at, const Eigen::MatrixXd& scores = {});

}  // namespace uncertainty_identification
