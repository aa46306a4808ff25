#pragma once

#include <Eigen/Core>

#include "estimation/likelihood.h"
#include "estimation/parametrisation.h"

namespace uncertainty_identification {

/// A point in unbounded coordinates with what one sweep says of it.
struct ScoredPoint {
  Eigen::VectorXd coordinates;
  ModelParameters parameters;
  Statistics statistics;
  double log_likelihood = 0;
  Eigen::VectorXd gradient;        ///< d log-likelihood/d coordinates
  Eigen::MatrixXd natural_scores;  ///< scores() of each experiment
};

/// One sweep. Where the coordinates lead outside the model's domain the log-likelihood is
/// -infinity.
ScoredPoint scoredPoint(const Likelihood& likelihood, const Parametrisation& parametrisation,
                        const Eigen::VectorXd& coordinates);

/// The observed information -d^2 log-likelihood/d coordinates^2 by differences of the exact
/// gradient: forward ones (one sweep per model parameter) or central ones (two). Mixture
/// coordinates need no sweep, the statistics stand.
Eigen::MatrixXd observedInformation(const Likelihood& likelihood,
                                    const Parametrisation& parametrisation, const ScoredPoint& at,
                                    bool central);

}  // namespace uncertainty_identification
