#pragma once

#include <Eigen/Core>

#include "estimation/likelihood.h"
#include "estimation/parametrisation.h"

namespace uncertainty_identification {

/// A point in unbounded coordinates with log-likelihood, gradient and statistics, from one sweep.
struct ScoredPoint {
  Eigen::VectorXd coordinates;
  ModelParameters parameters;
  Statistics statistics;
  double log_likelihood = 0;
  Eigen::VectorXd gradient;        ///< d log-likelihood/d coordinates
  Eigen::MatrixXd natural_scores;  ///< scores() of each experiment, in natural coordinates
};

/// Evaluates a point in one sweep. The log-likelihood is -infinity outside the model's domain.
ScoredPoint scoredPoint(const Likelihood& likelihood, const Parametrisation& parametrisation,
                        const Eigen::VectorXd& coordinates);

/// The observed information -d^2 log-likelihood/d coordinates^2, by finite differences of the exact
/// gradient: forward differences (one sweep per model parameter) or central ones (two), and one
/// sweep for their step widths unless the point was evaluated last. Mixture coordinates need no
/// sweep, because the statistics do not depend on them. A coordinate both of whose neighbours are
/// outside the model's domain has its expected information.
Eigen::MatrixXd observedInformation(const Likelihood& likelihood,
                                    const Parametrisation& parametrisation, const ScoredPoint& at,
                                    bool central);

}  // namespace uncertainty_identification
