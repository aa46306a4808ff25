#pragma once

#include <Eigen/Core>

#include "math/worker_pool.h"
#include "model/statistics.h"
#include "uncertainty_identification/math/mixture.h"

namespace uncertainty_identification {

/// All parameters of the likelihood: beta = [theta, gamma, sigma^2] of the paper
/// (docs/notation.md).
struct ModelParameters {
  Eigen::VectorXd parameters;  ///< theta, and the parameters of nuisances and effects
  Mixture mixture;             ///< gamma
  double noise_variance = 1;   ///< sigma^2
};

/// The results of the E-step for all experiments r and components i. Columns of `means` and
/// `covariances` are in the order r kappa + i.
struct Expectation {
  Eigen::VectorXd log_likelihood;    ///< of each experiment, log-Jacobian included (M)
  Eigen::MatrixXd responsibilities;  ///< zeta_ir, equation (23), kappa x M
  Eigen::MatrixXd means;             ///< posterior means of xi, (31), n x kappa M
  Eigen::MatrixXd covariances;       ///< posterior covariances, (32), n^2 x kappa M
  Eigen::MatrixXd misfits;           ///< R_ir, (33), kappa x M

  double total() const { return log_likelihood.sum(); }
};

/// Evaluates equations (16)-(18), (23), (31)-(33) from the sufficient statistics (docs/method.md),
/// with Gamma = L L'. This needs no N x N matrix and no inverse of Gamma, which may be singular.
Expectation expectation(const Statistics& statistics, const Mixture& mixture, double noise_variance,
                        WorkerPool* pool);

/// A matrix L with covariance = L L'. The covariance may be singular.
Eigen::MatrixXd squareRoot(const Eigen::MatrixXd& covariance);

/// Posterior mean and covariance of xi for each experiment, over all components of the mixture.
struct LatentMoments {
  Eigen::MatrixXd means;        ///< m_r, n x M
  Eigen::MatrixXd covariances;  ///< P_r = E[(xi - m_r)(xi - m_r)'], n^2 x M
};
LatentMoments latentMoments(const Expectation& expectation);

/// Scores: the derivatives of each experiment's log-likelihood (columns) with respect to the
/// natural coordinates
///   [parameters; weights; means; covariances (lower triangles, row by row); log sigma^2],
/// computed by Fisher's identity (docs/method.md). The weights are treated as unconstrained.
/// `statistics` must contain derivatives.
Eigen::MatrixXd scores(const Statistics& statistics, const ModelParameters& at,
                       const Expectation& expectation);

}  // namespace uncertainty_identification
