#pragma once

#include <memory>
#include <vector>

#include "model/linear_model.h"
#include "model/sensitivity.h"

namespace uncertainty_identification {

/// A model whose plants differ in the parameters theta of Go instead of by filters in series with
/// Go.
///   sensitivity:       y = (Go + sum_i xi_i R_i) u + H omega, with R_i of SensitivityTerms;
///   parameter_spread:  y = Go(theta (1 + xi_r)) u + H omega, linearised in xi_r about a point t_r
///   of
///                      each experiment: for theta (1 + xi_r) near t_r,
///                      y = Go(t_r) u + sum_j (theta_j (1 + xi_rj) - t_rj) dGo(t_r)/dtheta_j u +
///                      ...
/// Where the initial state is unknown, the response that dGo/dtheta_j acts on includes the free
/// response with the most likely coefficients zeta_r of its columns: another t_r makes it decay
/// otherwise. What is estimated of the columns is then their distance from zeta_r.
/// H uses theta in both cases, even for parameters that it shares with Go. The points t_r are
/// constants: they do not change when theta is optimised. (Notation: docs/notation.md.)
class SensitivityModel : public LinearModel {
 public:
  /// `error_model` must have been completed by completeErrorModel(). `points` holds t_r as columns
  /// in the order of the data set (n x M), for parameter_spread only, and zeta_r below them where
  /// these are known; if empty, theta is used, as
  /// at the start of the fixed-point iteration. Throws ConfigurationError for names that the model
  /// lacks.
  SensitivityModel(std::shared_ptr<const NominalModel> nominal,
                   const ErrorModelOptions& error_model, const EstimationOptions& options,
                   Eigen::MatrixXd points = {});

  const SensitivityTerms& terms() const { return terms_; }

  void evaluate(const Block& block, const Eigen::VectorXd& parameters, bool derivatives,
                Response* response) const override;
  std::unique_ptr<const FusedSweep> prepare(const std::vector<Block>& blocks,
                                            const Eigen::VectorXd& parameters,
                                            bool derivatives) const override;

  /// Every experiment's t_r, inserted in theta, must be admissible, too.
  bool admissible(const Eigen::VectorXd& parameters) const override;

  bool isLocallyLinear() const override;
  Eigen::MatrixXd points(const Eigen::VectorXd& parameters,
                         const Eigen::MatrixXd& xi) const override;
  /// Below t_r, each column holds zeta_r.
  Eigen::MatrixXd pointsOf(const std::vector<Block>& blocks, const Eigen::VectorXd& parameters,
                           const Eigen::MatrixXd& xi) const override;
  Eigen::MatrixXd firstPoints(const std::vector<Block>& blocks, const Eigen::VectorXd& parameters,
                              int experiments) const override;
  std::unique_ptr<LinearModel> linearisedAbout(const Eigen::MatrixXd& points) const override;

 private:
  /// Whether the free response of each experiment is a part of what is linearised.
  bool knowsStart() const;
  Eigen::VectorXd at(const Eigen::VectorXd& point, const Eigen::VectorXd& theta) const;

  ErrorModelOptions error_model_;
  SensitivityTerms terms_;
  Eigen::MatrixXd points_;
};

/// The model that the options describe; a model that is only locally linear is linearised about
/// zero error parameters.
std::unique_ptr<LinearModel> makeLinearModel(std::shared_ptr<const NominalModel> nominal,
                                             const ErrorModelOptions& error_model,
                                             const EstimationOptions& options);

}  // namespace uncertainty_identification
