#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "estimation/expectation.h"
#include "model/model.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/math/mixture_coordinates.h"

namespace uncertainty_identification {

/// Unbounded coordinates of all parameters, in which the likelihood is maximised without
/// constraints: model parameters by Model::toUnbounded, the mixture by MixtureCoordinates, and log
/// sigma^2.
/// The natural coordinates are [parameters; weights; means; covariances; log sigma^2], as in
/// scores().
class Parametrisation {
 public:
  /// `floor` (n x n, positive semidefinite) is the smallest covariance that a component may have.
  Parametrisation(const Model& model, Constraint constraint, int components,
                  const Eigen::MatrixXd& floor);

  int size() const;  ///< number of unbounded coordinates
  int naturalSize() const;

  Eigen::VectorXd toCoordinates(const ModelParameters& parameters) const;
  ModelParameters fromCoordinates(const Eigen::VectorXd& coordinates) const;

  /// d(natural)/d(coordinates), naturalSize() x size().
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& coordinates) const;

  /// Names of the natural coordinates: "b1", "weight1", "mean1[1]", "covariance1[1,1]",
  /// "noise_variance".
  std::vector<std::string> naturalNames() const;

  /// Values of the natural coordinates, but with sigma^2 instead of its logarithm.
  Eigen::VectorXd natural(const ModelParameters& parameters) const;

  /// Number of coordinates that belong to the model's parameters. They come first; only these need
  /// a sweep over the samples when they change.
  int modelCoordinates() const { return p_; }

 private:
  bool zeroMean() const { return constraint_ == Constraint::zero_mean; }
  int freeMeans() const { return zeroMean() ? kappa_ - 1 : kappa_; }

  const Model& model_;
  Constraint constraint_;
  int p_, n_, kappa_, triangle_;
  MixtureCoordinates mixture_;
};

}  // namespace uncertainty_identification
