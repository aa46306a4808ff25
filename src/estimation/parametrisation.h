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
/// constraints:
///   model parameters through Model::toUnbounded; the mixture through MixtureCoordinates;
///   log sigma^2.
/// and natural coordinates [parameters; weights; means; covariances; log sigma^2] as of scores().
class Parametrisation {
 public:
  /// `floor` (n x n, positive semidefinite) is the smallest covariance a component may take
  /// while the likelihood is maximised.
  Parametrisation(const Model& model, Constraint constraint, int components,
                  const Eigen::MatrixXd& floor);

  int size() const;  ///< unbounded coordinates
  int naturalSize() const;

  Eigen::VectorXd toCoordinates(const ModelParameters& parameters) const;
  ModelParameters fromCoordinates(const Eigen::VectorXd& coordinates) const;

  /// d(natural)/d(coordinates), naturalSize() x size().
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& coordinates) const;

  /// Natural coordinates' names: "b1", "weight1", "mean1[1]", "covariance1[1,1]", "noise_variance".
  std::vector<std::string> naturalNames() const;

  /// Natural coordinates' values, the last one sigma^2 itself.
  Eigen::VectorXd natural(const ModelParameters& parameters) const;

  /// Index of the first coordinate that no sweep is needed for: those before it are the model's
  /// parameters.
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
