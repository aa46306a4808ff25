#include <cmath>

#include "estimation/climb.h"
#include "estimation/parametrisation.h"
#include "estimation/scoring.h"

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
VectorXd stacked(const Likelihood& likelihood, const ModelParameters& at) {
  return Parametrisation(likelihood.model(), Constraint::free, at.mixture.components(), MatrixXd())
      .natural(at);
}

}  // namespace

Climb expectationMaximisation(const Likelihood& likelihood, const ModelParameters& start,
                              const ClimbOptions& options) {
  constexpr int kInformationAge = 4;  // iterations a Gauss-Newton matrix serves; it changes slowly
  const Eigen::Index p = likelihood.model().parameterCount();
  Climb climb;
  climb.at = start;
  ModelParameters& at = climb.at;
  Statistics statistics = likelihood.statistics(at.parameters, true);
  Expectation e = likelihood.expect(statistics, at);
  Damping damping;
  MatrixXd information;
  int age = kInformationAge;
  climb.termination = Termination::iteration_limit;
  climb.message = "the iteration limit was reached; raise estimation.max_iterations";
  while (climb.iterations < options.max_iterations) {
    const VectorXd previous = stacked(likelihood, at);
    updateMixture(statistics, e, options, &at);  // (26)-(29)
    const bool pruned = pruneComponents(options.constraint, &at.mixture);
    e = likelihood.expect(statistics, at);  // (23), (31)-(33)

    const LatentMoments moments = latentMoments(e);
    if (age >= kInformationAge) {
      information = likelihood.information(at, moments).complete.topLeftCorner(p, p);
      age = 0;
    }
    const double cost = thetaCost(statistics, moments, at.noise_variance);
    const VectorXd gradient = scores(statistics, at, e).rowwise().sum().head(p);
    const bool moved = damping.step(information, gradient, [&](const VectorXd& step) {  // (34)
      const VectorXd theta = at.parameters + step;
      if (!likelihood.model().admissible(theta)) return false;
      Statistics there = likelihood.statistics(theta, true);
      if (!(thetaCost(there, moments, at.noise_variance) <= cost)) return false;
      at.parameters = theta;
      statistics = std::move(there);
      return true;
    });
    age = moved ? age + 1 : kInformationAge;
    e = likelihood.expect(statistics, at);
    ++climb.iterations;
    climb.log_likelihood = e.total();
    climb.trace.push_back({climb.iterations, likelihood.passes(), climb.log_likelihood});
    if (options.on_iterate && !options.on_iterate(climb.trace.back())) {
      climb.termination = Termination::cancelled;
      climb.message = "cancelled";
      break;
    }
    const VectorXd now = stacked(likelihood, at);
    if (!pruned && (now - previous).norm() < options.tolerance * now.norm()) {
      climb.termination = Termination::converged;
      climb.message = "the relative change of all parameters fell below the tolerance";
      break;
    }
  }
  climb.log_likelihood = e.total();
  return climb;
}

}  // namespace uncertainty_identification
