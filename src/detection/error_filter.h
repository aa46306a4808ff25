#pragma once

#include <Eigen/Core>
#include <vector>

#include "uncertainty_identification/math/mixture.h"

namespace uncertainty_identification {

/// One whitened sample, and how it depends on the unknown quantities:
///     e = (Phi + z'dPhi) xi - z'de + X c + omega,
/// where xi are the error parameters, theta = theta_hat + L z with L L' the covariance of
/// theta_hat, and c the coefficients of the diffuse columns (about which nothing is known
/// beforehand).
struct WhitenedObservation {
  double residual = 0;                    ///< e at theta_hat
  Eigen::VectorXd regressors;             ///< Phi (n)
  Eigen::VectorXd residual_derivative;    ///< de/dz (p; empty: theta counts as known)
  Eigen::MatrixXd regressor_derivatives;  ///< dPhi/dz (p x n)
  Eigen::VectorXd columns;                ///< X
};

/// How well a sample agrees with its prediction from the samples before it.
struct Score {
  /// Standard normal and independent of the scores of other samples if the model holds.
  double value = 0;
  double deviation = 0;    ///< standard deviation of the prediction [unit of y]
  double log_density = 0;  ///< of the sample's residual [nats]
  bool diffuse = false;    ///< the prediction depends on a coefficient of c that the samples so far
                           ///< do not determine; `value` is then meaningless
};

/// Recursive Bayesian estimate of the error parameters of the running experiment. For each
/// component of the mixture (4) there is one Kalman filter with the constant state (xi, z, c) and
/// the prior N(mu_i, Gamma_i), and the component's probability. If theta is known and there are no
/// diffuse columns, the estimate is exact: after an experiment, probabilities and means are (23)
/// and (31), and the log densities sum up to the likelihood (16). Products of z and xi are
/// linearised about the current mean. The filter can be copied to return to an earlier state.
class ErrorFilter {
 public:
  /// `parameters` is the size of z, `columns` that of c.
  ErrorFilter(const Mixture& mixture, Eigen::Index parameters, Eigen::Index columns,
              double noise_variance);

  /// Computes the score of the sample by the probability integral transform of its predictive
  /// distribution, a mixture of Gaussians, and then updates the estimate with it.
  Score update(const WhitenedObservation& observation);

  /// Probabilities of the components.
  std::vector<double> probabilities() const;

  /// Posterior mean of xi over all components (n).
  Eigen::VectorXd errorMean() const;

 private:
  struct Component {
    double log_weight = 0;
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
    Eigen::VectorXd direction;  ///< derivative of the last sample with respect to the state
    double innovation = 0, variance = 0;
  };

  void predict(const WhitenedObservation& observation, Component* component) const;
  void correct(Component* component) const;

  Eigen::Index dimension_, parameters_, columns_;
  double noise_variance_;
  std::vector<Component> components_;
};

}  // namespace uncertainty_identification
