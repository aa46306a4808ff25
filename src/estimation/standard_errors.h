#pragma once

#include <string>
#include <vector>

#include "estimation/observed_information.h"

namespace uncertainty_identification {

/// Covariances of all natural coordinates [parameters; weights; means; covariances; sigma^2] at a
/// maximum.
///
/// WARNING: these describe the error of the estimate when the model is true (observed) or of its
/// best approximation (robust), for many experiments. They are not the spread of the plant: that is
/// the mixture. Where the information is singular the coordinates concerned get NaN, and `singular`
/// says in words which ones the data cannot tell apart.
struct StandardErrors {
  Eigen::MatrixXd covariance;         ///< J H^-1 J', H the observed information
  Eigen::MatrixXd robust_covariance;  ///< sandwich J H^-1 (sum of score score') H^-1 J'; NaN for
                                      ///< fewer experiments than coordinates
  /// The same in the unbounded coordinates, where the singular directions are left out instead.
  Eigen::MatrixXd coordinate_covariance;
  Eigen::MatrixXd robust_coordinate_covariance;
  std::vector<std::string> singular;  ///< one sentence per direction
};

/// Two sweeps per model parameter.
StandardErrors standardErrors(const Likelihood& likelihood, const Parametrisation& parametrisation,
                              const ModelParameters& at);

}  // namespace uncertainty_identification
