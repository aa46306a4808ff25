#pragma once

#include <memory>
#include <vector>

#include "model/linear_model.h"
#include "model/sensitivity.h"

namespace uncertainty_identification {

/// The model whose error is that of Go's parameters, instead of filters behind Go.
///   sensitivity:       y = (Go + sum_i xi_i R_i) u + H omega, R_i of SensitivityTerms;
///   parameter_spread:  y = Go(theta (1 + xi_r)) u + H omega, linear in xi_r only about a point t_r
///                      of each experiment: with theta (1 + xi_r) near t_r,
///                      y = Go(t_r) u + sum_j (theta_j (1 + xi_rj) - t_rj) dGo(t_r)/dtheta_j u +
///                      ...
/// H stays at theta, whichever parameters it shares with Go. The points stay where they are while
/// theta moves: the derivatives are the experiment's, no property of theta.
class SensitivityModel : public LinearModel {
 public:
  /// `error_model` completed by completeErrorModel(). `points`: t_r as columns in the order of the
  /// data set (n x M), parameter_spread only; none: theta, a start. Throws ConfigurationError for
  /// names that the model lacks.
  SensitivityModel(std::shared_ptr<const NominalModel> nominal,
                   const ErrorModelOptions& error_model, const EstimationOptions& options,
                   Eigen::MatrixXd points = {});

  const SensitivityTerms& terms() const { return terms_; }

  void evaluate(const Block& block, const Eigen::VectorXd& parameters, bool derivatives,
                Response* response) const override;
  bool fusedStatistics(const Block& block, const Eigen::VectorXd& parameters, bool derivatives,
                       Statistics* statistics) const override;

  /// Also theta with every experiment's t_r must be admissible.
  bool admissible(const Eigen::VectorXd& parameters) const override;

  bool isLocallyLinear() const override;
  Eigen::MatrixXd points(const Eigen::VectorXd& parameters,
                         const Eigen::MatrixXd& xi) const override;
  std::unique_ptr<LinearModel> linearisedAbout(const Eigen::MatrixXd& points) const override;

 private:
  Eigen::VectorXd at(const Eigen::VectorXd& point, const Eigen::VectorXd& theta) const;

  ErrorModelOptions error_model_;
  SensitivityTerms terms_;
  Eigen::MatrixXd points_;
};

/// The model that the options name, about zero where it is linear only locally.
std::unique_ptr<LinearModel> makeLinearModel(std::shared_ptr<const NominalModel> nominal,
                                             const ErrorModelOptions& error_model,
                                             const EstimationOptions& options);

}  // namespace uncertainty_identification
