#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace uncertainty_identification {

/// Finite Gaussian mixture of the free error parameters xi, where eta = T xi are the coefficients
/// of the error model: equation (4) of the paper.
struct Mixture {
  std::vector<double> weights;         ///< alpha_i of the kappa components, positive, summing to 1
  std::vector<Eigen::VectorXd> means;  ///< mu_i, n each
  std::vector<Eigen::MatrixXd> covariances;  ///< Gamma_i, n x n, symmetric, positive semidefinite

  /// Number of components kappa.
  int components() const { return static_cast<int>(weights.size()); }

  /// Number of free error parameters n; 0 without an error model.
  int dimension() const { return means.empty() ? 0 : static_cast<int>(means.front().size()); }

  /// sum_i alpha_i mu_i (n).
  Eigen::VectorXd mean() const;

  /// Covariance of the whole mixture (n x n).
  Eigen::MatrixXd covariance() const;

  /// Orders the components by the first entry of the mean (then the second, ...), so that equal
  /// models are printed in the same way.
  void sortComponents();

  /// Throws ConfigurationError that names the entry unless the sizes agree, the weights are
  /// positive and sum to 1, and the covariances are symmetric and positive semidefinite.
  void validate(const std::string& name) const;
};

}  // namespace uncertainty_identification
