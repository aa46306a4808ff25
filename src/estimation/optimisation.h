#pragma once

#include <functional>
#include <string>
#include <vector>

#include "estimation/likelihood.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// Options and callbacks of both algorithms.
struct OptimisationOptions {
  Constraint constraint = Constraint::zero_static_gain;
  int max_iterations = 2000;
  double tolerance = 1e-6;
  /// Smallest covariance that an update may give a component (n x n). It prevents a component from
  /// collapsing onto one experiment. Constant during an optimisation, and not used when the
  /// likelihood is evaluated.
  Eigen::MatrixXd floor;
  /// Called after each iteration. Returning false cancels the optimisation.
  std::function<bool(const TracePoint&)> on_iterate;
};

/// The result of an optimisation.
struct Optimum {
  ModelParameters point;
  double log_likelihood = 0;
  Termination termination = Termination::not_run;
  std::string message;
  int iterations = 0;
  std::vector<TracePoint> trace;
  bool is_lost = false;  ///< not finite in the coordinates of the optimisation, which ended at once
};

/// Algorithm 1 of the paper with its stopping rule (section 5): E-step, equations (26)-(29), then a
/// Gauss-Newton step on (34)-(35). The observed log-likelihood does not decrease, except when a
/// component is removed.
Optimum expectationMaximisation(const Likelihood& likelihood, const ModelParameters& start,
                                const OptimisationOptions& options);

/// Maximises the observed log-likelihood over all parameters jointly: scoring steps, then NLopt's
/// L-BFGS with the exact gradient, in coordinates whitened by the observed information. Iterations
/// are the scoring steps and the evaluations of L-BFGS. Converged when the predicted gain of a
/// Newton step is less than options.tolerance [nats]. Where options.max_iterations is five or less
/// there are scoring steps only, which have converged when one gains less than that.
Optimum maximumLikelihood(const Likelihood& likelihood, const ModelParameters& start,
                          const OptimisationOptions& options);

/// Equations (26)-(29): sets the mixture and the noise variance of `point` to those that maximise Q
/// under the constraint and the floor.
void updateMixture(const Statistics& statistics, const Expectation& expectation,
                   const OptimisationOptions& options, ModelParameters* point);

/// EM for the mixture and the noise variance of `point` with fixed statistics, so without sweeps
/// over the samples. Returns the log-likelihood reached.
double fitMixture(const Likelihood& likelihood, const Statistics& statistics,
                  const OptimisationOptions& options, int iterations, double tolerance,
                  ModelParameters* point);

/// Removes components whose weight is below 1/(100 kappa) (paper, section 5). Returns whether any
/// was removed.
bool pruneComponents(Constraint constraint, Mixture* mixture);

/// The floor of OptimisationOptions for a start: 1e-4 times the pooled covariance of the mixture.
Eigen::MatrixXd covarianceFloor(const Mixture& start);

}  // namespace uncertainty_identification
