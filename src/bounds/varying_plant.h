#pragma once

#include <Eigen/Core>
#include <memory>

#include "model/sensitivity.h"
#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// Maps theta and xi to G = q^-delay B/A for error models that vary parameters of Go
/// (docs/notation.md explains theta, xi and Go).
class VaryingPlant {
 public:
  /// `nominal` must be given if the nominal model was defined by the caller; otherwise throws
  /// DataError.
  VaryingPlant(const Estimate& estimate, std::shared_ptr<const NominalModel> nominal);

  const NominalModel& nominal() const { return *nominal_; }
  const Eigen::VectorXd& theta() const { return theta_; }

  /// Whether the parameters lie in their domain. With parameter_spread the tail of the mixture may
  /// leave it.
  bool exists(const Eigen::VectorXd& theta, const Eigen::VectorXd& xi) const;

  /// b, a and delay of G. With basis sensitivity the denominator is a power of A, which can be
  /// computed only if A is well conditioned; throws DataError otherwise.
  Polynomials plant(const Eigen::VectorXd& theta, const Eigen::VectorXd& xi) const;

 private:
  Eigen::VectorXd moved(const Eigen::VectorXd& theta, const Eigen::VectorXd& xi) const;
  void checkConditioning() const;

  std::shared_ptr<const NominalModel> nominal_;
  BasisKind basis_;
  SensitivityTerms terms_;
  int order_;  ///< order of the derivatives
  Eigen::VectorXd theta_;
};

}  // namespace uncertainty_identification
