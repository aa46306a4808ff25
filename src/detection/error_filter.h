#pragma once

#include <Eigen/Core>
#include <vector>

#include "uncertainty_identification/math/mixture.h"

namespace uncertainty_identification {

/// One whitened sample and how it depends on what is not known:
///     e = (Phi + z'dPhi) xi - z'de + X c + omega,
/// xi the error parameters, theta = theta_hat + L z with L L' the covariance of theta_hat, and c
/// the coefficients of the diffuse columns.
struct WhitenedObservation {
  double residual = 0;                    ///< e at theta_hat
  Eigen::VectorXd regressors;             ///< Phi (n)
  Eigen::VectorXd residual_derivative;    ///< de/dz (p; empty: theta is taken as known)
  Eigen::MatrixXd regressor_derivatives;  ///< dPhi/dz (p x n)
  Eigen::VectorXd columns;                ///< X
};

/// What the samples before said of the one taken in.
struct Score {
  double value = 0;        ///< standard normal and independent over the samples, if the model holds
  double deviation = 0;    ///< standard deviation of the prediction [unit of y]
  double log_density = 0;  ///< of the sample's residual [nats]
  bool diffuse = false;    ///< the prediction hangs on a coefficient about which nothing is known
                           ///< yet: not a score
};

/// Recursive Bayesian estimate of the error parameters of the running experiment: one Kalman filter
/// on constant xi (and z and c) for each component of the mixture (4), with prior N(mu_i, Gamma_i),
/// and the components' probabilities. With theta known and without diffuse columns it is exact:
/// after an experiment, probabilities and means are (23) and (31), and the log densities add up to
/// the likelihood (16). The products z xi are linearised about the current mean. Copies are cheap:
/// keep one to go back to.
class ErrorFilter {
 public:
  /// `parameters` is the size of z, `columns` that of c.
  ErrorFilter(const Mixture& mixture, Eigen::Index parameters, Eigen::Index columns,
              double noise_variance);

  /// Scores the sample by the probability integral transform of its predictive distribution, a
  /// mixture of Gaussians, then takes it in.
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
    Eigen::VectorXd direction;  ///< of the last sample: dependence on the state
    double innovation = 0, variance = 0;
  };

  void predict(const WhitenedObservation& observation, Component* component) const;
  void takeIn(bool diffuse, Component* component) const;

  Eigen::Index dimension_, parameters_, columns_;
  double noise_variance_;
  std::vector<Component> components_;
};

}  // namespace uncertainty_identification
