#include "estimation/scoring.h"

#include <Eigen/Cholesky>

namespace uncertainty_identification {

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool Damping::step(const MatrixXd& information, const VectorXd& gradient,
                   const std::function<bool(const VectorXd&)>& improves) {
  const VectorXd diagonal = information.diagonal().cwiseAbs().array() + 1e-300;
  for (int attempt = 0; attempt < 12; ++attempt) {
    MatrixXd damped = information;
    damped.diagonal() += lambda_ * diagonal;
    const Eigen::LLT<MatrixXd> factor(damped);
    if (factor.info() == Eigen::Success) {
      const VectorXd step = factor.solve(gradient);
      if (step.allFinite() && improves(step)) {
        lambda_ = std::max(lambda_ / 8, 1e-9);
        return true;
      }
    }
    lambda_ = std::max(lambda_ * 8, 1e-6);
  }
  return false;
}

ModelParameters scoringSteps(const Likelihood& likelihood, ModelParameters at,
                             const ClimbOptions& options, int steps, double tolerance) {
  constexpr int kMixtureSteps = 10;
  const Eigen::Index p = likelihood.model().parameterCount(), n = likelihood.model().regressors();
  const bool shift = options.constraint != Constraint::zero_mean && n > 0;
  const Eigen::Index size = shift ? p + n : p;
  Damping damping;
  Statistics statistics = likelihood.statistics(at.parameters, true);
  double reached = fitMixture(likelihood, statistics, options, kMixtureSteps, tolerance, &at);
  for (int k = 0; k < steps && size > 0; ++k) {
    const double before = reached;
    const Expectation e = likelihood.expect(statistics, at);
    const VectorXd score = scores(statistics, at, e).rowwise().sum();
    VectorXd gradient(size);
    gradient.head(p) = score.head(p);
    if (shift) {
      gradient.tail(n).setZero();
      const int kappa = at.mixture.components();
      for (int i = 0; i < kappa; ++i) gradient.tail(n) += score.segment(p + kappa + i * n, n);
    }
    const MatrixXd information =
        likelihood.information(at, latentMoments(e)).observed.topLeftCorner(size, size);
    const bool moved = damping.step(information, gradient, [&](const VectorXd& step) {
      ModelParameters trial = at;
      trial.parameters += step.head(p);
      for (VectorXd& mean : trial.mixture.means) {
        if (shift) mean += step.tail(n);
      }
      if (!likelihood.model().admissible(trial.parameters)) return false;
      Statistics there = likelihood.statistics(trial.parameters, true);
      const double value = likelihood.expect(there, trial).total();
      if (!(value >= reached)) return false;
      at = std::move(trial);
      statistics = std::move(there);
      return true;
    });
    if (!moved) break;
    reached = fitMixture(likelihood, statistics, options, kMixtureSteps, tolerance, &at);
    const bool going_on =
        !options.on_iterate || options.on_iterate({k + 1, likelihood.passes(), reached});
    if (!going_on || reached - before < tolerance) break;
  }
  return at;
}

}  // namespace uncertainty_identification
