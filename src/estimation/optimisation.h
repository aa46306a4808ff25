#pragma once

#include <functional>
#include <string>
#include <vector>

#include "estimation/likelihood.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// What both algorithms need besides the likelihood and a start.
struct OptimisationOptions {
  Constraint constraint = Constraint::zero_static_gain;
  int max_iterations = 2000;
  double tolerance = 1e-6;
  /// Smallest covariance that an update may give a component (n x n): it keeps a component from
  /// collapsing onto one experiment. The same throughout an optimisation; evaluating the likelihood
  /// does not use it.
  Eigen::MatrixXd floor;
  /// Called after each iteration; returning false cancels the optimisation.
  std::function<bool(const TracePoint&)> on_iterate;
};

/// Where an optimisation ended.
struct Optimum {
  ModelParameters point;
  double log_likelihood = 0;
  Termination termination = Termination::not_run;
  std::string message;
  int iterations = 0;
  std::vector<TracePoint> trace;
};

/// The paper's Algorithm 1, with its stopping rule (section 5): E-step, equations (26)-(29), then a
/// Gauss-Newton step on (34)-(35). The observed log-likelihood never decreases, except where a
/// component is removed.
Optimum expectationMaximisation(const Likelihood& likelihood, const ModelParameters& start,
                                const OptimisationOptions& options);

/// Joint scoring steps, then NLopt's L-BFGS on the observed log-likelihood with its exact gradient,
/// in coordinates whitened by the observed information. Scoring steps and evaluations of L-BFGS
/// count as iterations. Converged when the predicted gain of a Newton step falls below
/// options.tolerance [nats].
Optimum maximumLikelihood(const Likelihood& likelihood, const ModelParameters& start,
                          const OptimisationOptions& options);

/// Equations (26)-(29): the mixture and the noise variance of `point` that maximise Q, under the
/// constraint and the floor.
void updateMixture(const Statistics& statistics, const Expectation& expectation,
                   const OptimisationOptions& options, ModelParameters* point);

/// EM on the mixture and the noise variance of `point` alone, at fixed statistics, so without a
/// sweep over the samples. Returns the log-likelihood reached.
double fitMixture(const Likelihood& likelihood, const Statistics& statistics,
                  const OptimisationOptions& options, int iterations, double tolerance,
                  ModelParameters* point);

/// Removes components of weight below 1/(100 kappa) (paper, section 5); whether there were any.
bool pruneComponents(Constraint constraint, Mixture* mixture);

/// The floor of OptimisationOptions for a start: 1e-4 of the mixture's pooled covariance.
Eigen::MatrixXd covarianceFloor(const Mixture& start);

}  // namespace uncertainty_identification
