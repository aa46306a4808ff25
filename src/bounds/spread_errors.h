#pragma once

#include <Eigen/Core>
#include <vector>

#include "uncertainty_identification/math/mixture.h"

namespace uncertainty_identification {

/// The errors of the mixture's covariances that few experiments leave. A covariance that is
/// estimated from M experiments is too small by M/(M - 1) in the mean, and may be much too small:
/// its errors are those of the Wishart distribution, not Gaussian ones. With 8 experiments a
/// further one lies within 2.68 estimated standard deviations of the mean with a probability of 95
/// % (Student's t), where Gaussian errors of the estimate say 2.2.
class SpreadErrors {
 public:
  /// `mixture` is the estimate from `experiments` experiments (0: unknown, errors stay Gaussian).
  /// `covariance` is that of the estimate's errors in the coordinates of MixtureCoordinates; its
  /// last rows belong to the roots L_i of the covariances.
  SpreadErrors(const Mixture& mixture, const Eigen::MatrixXd& covariance, int experiments);

  /// Replaces the roots in `mixture_coordinates`, which hold the estimate `center` and Gaussian
  /// errors, by roots with the errors of few experiments. A coordinate keeps its rank among the
  /// draws, so that it stays correlated with the other parameters as before.
  void replaceRoots(const Eigen::VectorXd& center, Eigen::VectorXd* mixture_coordinates) const;

 private:
  /// A component whose covariance is not singular.
  struct Component {
    Eigen::Index first;    ///< of its root's entries among the mixture's coordinates
    double experiments;    ///< its share of the experiments
    Eigen::MatrixXd root;  ///< L (n x n), lower triangular
    Eigen::VectorXd
        standard;  ///< standard deviations of the entries of L^-1 times the root's error
    Eigen::VectorXd widening;  ///< >= 1, variances relative to those from experiments without noise
  };
  Eigen::MatrixXd drawnRoot(const Component& component, const Eigen::MatrixXd& gaussian) const;

  std::vector<Component> components_;
};

}  // namespace uncertainty_identification
