#pragma once

#include <Eigen/Core>

namespace uncertainty_identification {

/// Sufficient statistics of every experiment r, computed in one sweep over the samples: the Gram
/// matrix of [Phi e] after random-effect columns have been integrated out,
///     [S v; v' s],  S = Phi'Phi (n x n), v = Phi'e (n), s = e'e,
/// the number of samples N_r in the likelihood, its log-Jacobian, and the derivatives of all of
/// these with respect to the p model parameters. Mixture updates need these statistics only, and no
/// samples. (Phi: regressors, e: residual; docs/notation.md.)
class Statistics {
 public:
  Statistics() = default;
  Statistics(int experiments, int regressors, int parameters)
      : regressors_(regressors),
        parameters_(parameters),
        grams_(entries(), experiments),
        gram_derivatives_(entries() * parameters, experiments),
        samples_(experiments),
        log_jacobian_(experiments),
        log_jacobian_derivatives_(parameters, experiments) {}

  int experiments() const { return static_cast<int>(samples_.size()); }
  int regressors() const { return regressors_; }

  /// Number p of parameters with derivatives; 0 if only values were requested.
  int parameters() const { return parameters_; }

  using Gram = Eigen::Map<Eigen::MatrixXd>;
  using ConstGram = Eigen::Map<const Eigen::MatrixXd>;

  /// Gram matrix of [Phi e], (n + 1) x (n + 1), symmetric.
  Gram gram(int r) { return {grams_.col(r).data(), regressors_ + 1, regressors_ + 1}; }
  ConstGram gram(int r) const { return {grams_.col(r).data(), regressors_ + 1, regressors_ + 1}; }

  /// Derivative of gram(r) with respect to parameter j.
  Gram gramDerivative(int r, int j) {
    return {gram_derivatives_.col(r).data() + entries() * j, regressors_ + 1, regressors_ + 1};
  }
  ConstGram gramDerivative(int r, int j) const {
    return {gram_derivatives_.col(r).data() + entries() * j, regressors_ + 1, regressors_ + 1};
  }

  Eigen::VectorXd& samples() { return samples_; }
  const Eigen::VectorXd& samples() const { return samples_; }
  Eigen::VectorXd& logJacobian() { return log_jacobian_; }
  const Eigen::VectorXd& logJacobian() const { return log_jacobian_; }
  Eigen::MatrixXd& logJacobianDerivatives() { return log_jacobian_derivatives_; }
  const Eigen::MatrixXd& logJacobianDerivatives() const { return log_jacobian_derivatives_; }

 private:
  Eigen::Index entries() const {
    return static_cast<Eigen::Index>(regressors_ + 1) * (regressors_ + 1);
  }

  int regressors_ = 0, parameters_ = 0;
  Eigen::MatrixXd grams_, gram_derivatives_;  // one column per experiment
  Eigen::VectorXd samples_, log_jacobian_;
  Eigen::MatrixXd log_jacobian_derivatives_;  // p x M
};

}  // namespace uncertainty_identification
