#pragma once

#include <functional>
#include <string>
#include <vector>

#include "estimation/likelihood.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// What both algorithms need besides the likelihood and a start.
struct ClimbOptions {
  Constraint constraint = Constraint::zero_static_gain;
  int max_iterations = 2000;
  double tolerance = 1e-6;
  /// Smallest covariance a component's update may take (n x n): keeps a component from collapsing
  /// onto one experiment. Fixed within a run; acts on updates, never on evaluation.
  Eigen::MatrixXd floor;
  /// Called at each accepted iterate; returning false cancels.
  std::function<bool(const TracePoint&)> on_iterate;
};

/// Where a climb ended.
struct Climb {
  ModelParameters at;
  double log_likelihood = 0;
  Termination termination = Termination::not_run;
  std::string message;
  int iterations = 0;
  std::vector<TracePoint> trace;
};

/// The paper's Algorithm 1, with its stopping rule (section 5): E-step, equations (26)-(29), then a
/// Gauss-Newton step on (34)-(35). The observed log-likelihood never decreases, pruning of
/// components excepted.
Climb expectationMaximisation(const Likelihood& likelihood, const ModelParameters& start,
                              const ClimbOptions& options);

/// Joint scoring steps, then the observed log-likelihood climbed with its exact gradient by NLopt's
/// L-BFGS in coordinates whitened by the observed information. Stops when the gain that is
/// predicted to be left falls below options.tolerance [nats].
Climb maximumLikelihood(const Likelihood& likelihood, const ModelParameters& start,
                        const ClimbOptions& options);

/// A few joint scoring steps on (theta, common shift of all means), each followed by mixture
/// updates: the cheap way from a rough start to the neighbourhood of an optimum. Stops early when a
/// step gains less than `tolerance` [nats].
ModelParameters scoringSteps(const Likelihood& likelihood, ModelParameters at,
                             const ClimbOptions& options, int steps, double tolerance);

/// Equations (26)-(29): the mixture and the noise variance that maximise Q, under the constraint
/// and the floor.
void updateMixture(const Statistics& statistics, const Expectation& expectation,
                   const ClimbOptions& options, ModelParameters* at);

/// EM on the mixture and the noise variance alone, at fixed statistics: no sweep. Returns the
/// log-likelihood reached.
double fitMixture(const Likelihood& likelihood, const Statistics& statistics,
                  const ClimbOptions& options, int iterations, double tolerance,
                  ModelParameters* at);

/// Removes components of weight below 1/(100 kappa) (paper, section 5); whether there were any.
bool pruneComponents(Constraint constraint, Mixture* mixture);

/// The floor of ClimbOptions for a start: 1e-4 of the mixture's pooled covariance.
Eigen::MatrixXd covarianceFloor(const Mixture& start);

}  // namespace uncertainty_identification
