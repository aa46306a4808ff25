#pragma once

#include <memory>

#include "uncertainty_identification/model/error_basis.h"
#include "uncertainty_identification/model/model.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// The paper's model (2), (13): y = Go (1 + GDelta(eta_r)) u + H omega with the nuisances of real
/// records, an unknown initial state of Go, noise that was running before the first sample, missing
/// outputs, an operating point. Parameters: theta of the nominal model, then `offset_y` or
/// `offset_u` where a common offset is estimated.
class LinearModel : public Model {
 public:
  /// Only the nuisance options of `options` are used (initial_state, discard_samples, noise_start,
  /// offsets, offset_side).
  LinearModel(std::shared_ptr<const NominalModel> nominal, const ErrorBasis& basis,
              const EstimationOptions& options);

  const NominalModel& nominal() const { return *nominal_; }
  const ErrorBasis& basis() const { return basis_; }

  std::vector<std::string> names() const override;
  int regressors() const override { return basis_.dimension(); }
  void evaluate(const Block& block, const Eigen::VectorXd& parameters, bool derivatives,
                Response* response) const override;
  bool fusedStatistics(const Block& block, const Eigen::VectorXd& parameters, bool derivatives,
                       Statistics* statistics) const override;
  bool admissible(const Eigen::VectorXd& parameters) const override;
  Eigen::VectorXd toUnbounded(const Eigen::VectorXd& parameters) const override;
  Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& unbounded) const override;
  Eigen::MatrixXd unboundedJacobian(const Eigen::VectorXd& unbounded) const override;

  /// Free simulation Go u of one block (plus the offset), from rest: what the nominal model alone
  /// predicts.
  Signals simulate(const Block& block, const Eigen::VectorXd& parameters) const;

 private:
  bool hasCommonOffset() const { return options_.offsets == Offsets::estimate; }
  Eigen::VectorXd theta(const Eigen::VectorXd& parameters) const;

  std::shared_ptr<const NominalModel> nominal_;
  ErrorBasis basis_;
  EstimationOptions options_;
};

}  // namespace uncertainty_identification
