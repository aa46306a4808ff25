#include <cmath>

#include "estimation/parametrisation.h"
#include "estimation/scoring.h"
#include "estimation/stopwatch.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The part of -Q that depends on theta, from (34)-(35): 1/(2 sigma^2) sum_r [s - 2 m'v + tr(M S)]
/// - sum_r log-Jacobian.
double thetaCost(const Statistics& statistics, const LatentMoments& moments,
                 double noise_variance) {
  const Eigen::Index n = statistics.regressors();
  double misfit = 0;
  for (int r = 0; r < statistics.experiments(); ++r) {
    const Statistics::ConstGram gram = statistics.gram(r);
    const auto m = moments.means.col(r);
    const auto S = gram.topLeftCorner(n, n);
    const Eigen::Map<const MatrixXd> P(moments.covariances.col(r).data(), n, n);
    misfit += gram(n, n) - 2 * m.dot(gram.topRightCorner(n, 1).col(0)) + m.dot(S * m) +
              S.cwiseProduct(P).sum();
  }
  return 0.5 * misfit / noise_variance - statistics.logJacobian().sum();
}

/// All parameters as one vector, for the stopping rule.
VectorXd stacked(const Likelihood& likelihood, const ModelParameters& point) {
  return Parametrisation(likelihood.model(), Constraint::free, point.mixture.components(),
                         MatrixXd())
      .natural(point);
}

Optimum ended(Optimum optimum, Termination termination, const std::string& message) {
  optimum.termination = termination;
  optimum.message = message;
  return optimum;
}

/// Takes the step of theta if it is admissible and does not raise the cost (34); whether it did.
bool lowersThetaCost(const Likelihood& likelihood, const LatentMoments& moments,
                     const VectorXd& step, ModelParameters* point, Statistics* statistics) {
  const VectorXd theta = point->parameters + step;
  if (!likelihood.model().admissible(theta)) return false;
  const double cost = thetaCost(*statistics, moments, point->noise_variance);
  Statistics there = likelihood.statistics(theta, true);
  if (!(thetaCost(there, moments, point->noise_variance) <= cost)) return false;
  point->parameters = theta;
  *statistics = std::move(there);
  return true;
}

}  // namespace

Optimum expectationMaximisation(const Likelihood& likelihood, const ModelParameters& start,
                                const OptimisationOptions& options) {
  constexpr int kInformationAge = 4;  // iterations a Gauss-Newton matrix serves; it changes slowly
  const Eigen::Index p = likelihood.model().parameterCount();
  Optimum optimum;
  optimum.point = start;
  ModelParameters& point = optimum.point;
  Statistics statistics = likelihood.statistics(point.parameters, true);
  Expectation e = likelihood.expect(statistics, point);
  Damping damping;
  MatrixXd information;
  int age = kInformationAge;
  optimum.termination = Termination::iteration_limit;
  optimum.message = "the iteration limit was reached; raise estimation.max_iterations";
  while (optimum.iterations < options.max_iterations) {
    const Stopwatch watch;
    const VectorXd previous = stacked(likelihood, point);
    updateMixture(statistics, e, options, &point);  // (26)-(29)
    const bool pruned = pruneComponents(options.constraint, &point.mixture);
    e = likelihood.expect(statistics, point);  // (23), (31)-(33)

    const LatentMoments moments = latentMoments(e);
    if (age >= kInformationAge) {
      information = likelihood.information(point, moments).complete.topLeftCorner(p, p);
      age = 0;
    }
    const VectorXd gradient = scores(statistics, point, e).rowwise().sum().head(p);
    const auto moved = damping.step(information, gradient, [&](const VectorXd& step) {  // (34)
      return lowersThetaCost(likelihood, moments, step, &point, &statistics);
    });
    age = moved ? age + 1 : kInformationAge;
    e = likelihood.expect(statistics, point);
    ++optimum.iterations;
    optimum.log_likelihood = e.total();
    const StepSummary step{moved ? moved->norm() : 0.0, gradient.norm(), moved.has_value(),
                           watch.seconds()};
    optimum.trace.push_back(
        {optimum.iterations, likelihood.passes(), optimum.log_likelihood, step});
    if (options.on_iterate && !options.on_iterate(optimum.trace.back()))
      return ended(optimum, Termination::cancelled, "cancelled");
    const VectorXd now = stacked(likelihood, point);
    if (!pruned && (now - previous).norm() < options.tolerance * now.norm()) {
      return ended(optimum, Termination::converged,
                   "the relative change of all parameters fell below the tolerance");
    }
  }
  optimum.log_likelihood = e.total();
  return optimum;
}

}  // namespace uncertainty_identification
