#pragma once

#include <functional>

#include "estimation/optimisation.h"

namespace uncertainty_identification {

/// Levenberg-Marquardt damping that carries over from one step to the next.
class Damping {
 public:
  /// Tries steps (information + lambda diag)^-1 gradient with growing lambda until `improves(step)`
  /// accepts one. Returns that step; none where no step was accepted.
  std::optional<Eigen::VectorXd> step(const Eigen::MatrixXd& information,
                                      const Eigen::VectorXd& gradient,
                                      const std::function<bool(const Eigen::VectorXd&)>& improves);

 private:
  double lambda_ = 1e-6;
};

/// At most `steps` joint Gauss-Newton (scoring) steps on theta and a common shift of all means,
/// each followed by mixture updates at fixed theta: the cheap way from a rough start to the
/// neighbourhood of an optimum. The likelihood never decreases. Ends early after a step that gains
/// less than `tolerance` [nats], where no step is accepted, or when options.on_iterate cancels.
/// Writes the log-likelihood of the returned point unless the pointer is null.
ModelParameters scoringSteps(const Likelihood& likelihood, ModelParameters start,
                             const OptimisationOptions& options, int steps, double tolerance,
                             double* log_likelihood = nullptr);

}  // namespace uncertainty_identification
