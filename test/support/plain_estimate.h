#pragma once

#include <Eigen/Core>

#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/model/error_basis.h"

namespace uncertainty_identification::test {

/// An estimate as an identification would leave it, of a plant q^-1 B/A and an error model with
/// two taps: two components about -1 and 1 of variance 0.2, the paper's Example 1. Errors of the
/// estimate: independent, of variance `error` in each unbounded coordinate.
inline Estimate plainEstimate(const Eigen::VectorXd& b, const Eigen::VectorXd& a,
                              double error = 1e-6) {
  Estimate estimate;
  estimate.termination = Termination::converged;
  estimate.nominal_model.structure = "box_jenkins";
  estimate.nominal_model.sample_time = 0.1;
  estimate.nominal_model.delay = 1;
  estimate.nominal_model.b = b;
  estimate.nominal_model.a = a;
  estimate.noise_variance.value = 0.1;
  estimate.error_model.options = paperErrorModel();
  estimate.error_model.options.components = 2;
  estimate.error_model.T = ErrorBasis(estimate.error_model.options).T();
  const auto scalar = [](double x) { return Eigen::MatrixXd::Constant(1, 1, x); };
  estimate.error_model.mixture = {{0.5, 0.5},
                                  {Eigen::VectorXd::Constant(1, -1), Eigen::VectorXd::Ones(1)},
                                  {scalar(0.2), scalar(0.2)}};
  const Eigen::Index coordinates = b.size() + a.size() + 5;  // and a ratio, two means, two roots
  estimate.joint_covariance = error * Eigen::MatrixXd::Identity(coordinates, coordinates);
  return estimate;
}

/// The same without an error model.
inline Estimate estimateWithoutErrorModel(const Eigen::VectorXd& b, const Eigen::VectorXd& a,
                                          double error = 1e-6) {
  Estimate estimate = plainEstimate(b, a, error);
  estimate.error_model.options.taps = 0;
  estimate.error_model.T.resize(0, 0);
  estimate.error_model.mixture = {{1.0}, {Eigen::VectorXd(0)}, {Eigen::MatrixXd(0, 0)}};
  estimate.joint_covariance =
      error * Eigen::MatrixXd::Identity(b.size() + a.size(), b.size() + a.size());
  return estimate;
}

}  // namespace uncertainty_identification::test
