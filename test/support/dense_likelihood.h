#pragma once

#include <Eigen/Core>
#include <vector>

#include "support/dense_signals.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/math/mixture.h"

/// Reference likelihood: Lemma 1 of the paper, (16)-(18), written out with N x N matrices in the
/// space of the measured outputs. Slow and plain on purpose; the fast likelihood is judged by it.
///
/// Of the observed outputs y (N_obs of them), component i has
///   mean        m_i = Go u + Psi mu_i + offset,   Psi = Go F(u) T        (17)
///   covariance  V_i = sigma^2 R + Psi Gamma_i Psi'                       (18)
/// with R the covariance of H omega / sigma at the observed samples. An experiment whose outputs
/// also hold diffuse directions X (N_obs x k, rank p, coefficients with a flat prior of density 1)
/// has
///   -2 log p_i = (N_obs - p) log 2 pi + log det V_i + log det(X' V_i^-1 X) + r' P_i r,   r = y -
///   m_i, P_i = V_i^-1 - V_i^-1 X (X' V_i^-1 X)^-1 X' V_i^-1.
/// With sigma^2 taken out and everything whitened by the factor of R this is, term by term,
/// residual and regressors projected off X, N_obs - p in place of N_obs beside log(2 pi sigma^2),
/// and -1/2 log det(X' R^-1 X). Where the observed directions are linearly dependent, det is the
/// product of the nonzero eigenvalues.
namespace uncertainty_identification::dense {

/// A nominal model, a noise model and the distribution of the relative error model.
struct Model {
  Eigen::VectorXd b;        ///< b1..b_nb; Go = q^-delay (b1 + b2 q^-1 + ...) / A
  Eigen::VectorXd a, c, d;  ///< without the leading 1
  int delay = 1;            ///< [samples]
  Eigen::MatrixXd
      basis;  ///< column k: impulse response of basis filter F_k; zero beyond its last row
  Eigen::VectorXd
      basis_denominator;  ///< common denominator of the F_k without the leading 1; empty for FIR
  int basis_order = 0;  ///< highest power of q^-1 in the F_k or their denominator: taps - 1 for FIR
  Eigen::MatrixXd T;    ///< taps x n
  Mixture mixture;      ///< of xi (n); no components = no error model
  double noise_variance = 1;  ///< sigma^2
};

/// How an experiment starts, and what else is part of its output.
struct Options {
  NoiseStart noise_start = NoiseStart::zero;
  /// zero: Go at rest before sample 0. discard: the same, and the first samples count as not
  /// measured. estimate: any input before sample 0, as stateDirections() with a flat prior.
  InitialState initial_state = InitialState::zero;
  int discard_samples = 0;
  double input_offset = 0;      ///< subtracted from every u
  double output_offset = 0;     ///< subtracted from every y
  bool diffuse_offset = false;  ///< an output offset per experiment, with a flat prior
};

/// What the model says about one experiment.
struct Evaluation {
  double log_likelihood = 0;
  int degrees_of_freedom = 0;                ///< N_obs - p
  std::vector<double> responsibilities;      ///< zeta_ir of (23)
  std::vector<Eigen::VectorXd> error_means;  ///< posterior mean of xi under each component, (31)
  std::vector<Eigen::MatrixXd> error_covariances;  ///< posterior covariance, (32)
};

/// Covariance of H omega / sigma over `samples` samples: H H' from rest, or the Toeplitz matrix of
/// the autocovariance.
Matrix noiseCovariance(const Model& model, NoiseStart start, int samples);

/// Responses of Go (1 + GDelta) to its past (samples x K): q^-j / (A times the basis denominator),
/// j = 0..K-1, with K = max(na + basis poles, delay + nb - 1 + basis_order).
Matrix stateDirections(const Model& model, int samples);

/// Log-likelihood and posterior of one experiment.
Evaluation evaluate(const Experiment& experiment, const Model& model, const Options& options = {});

/// Observed log-likelihood (16): the sum over the experiments.
double logLikelihood(const std::vector<Experiment>& experiments, const Model& model,
                     const Options& options = {});

}  // namespace uncertainty_identification::dense
