#pragma once

#include <Eigen/Core>
#include <memory>

#include "model/sensitivity.h"
#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// The plants of an error model that varies Go's parameters: theta and xi in, G = q^-delay B/A out.
class VaryingPlant {
 public:
  /// Throws DataError where the estimate's nominal model is none of this package's, unless
  /// `nominal` gives it.
  VaryingPlant(const Estimate& estimate, std::shared_ptr<const NominalModel> nominal);

  const NominalModel& nominal() const { return *nominal_; }
  const Eigen::VectorXd& theta() const { return theta_; }

  /// Whether there is such a plant: with parameter_spread a tail of the mixture may leave the
  /// parameters' domain.
  bool exists(const Eigen::VectorXd& theta, const Eigen::VectorXd& xi) const;

  /// b, a and delay of G. With basis sensitivity the denominator is a power of A, which is computed
  /// with where A is well conditioned only: throws DataError elsewhere.
  Polynomials plant(const Eigen::VectorXd& theta, const Eigen::VectorXd& xi) const;

 private:
  Eigen::VectorXd moved(const Eigen::VectorXd& theta, const Eigen::VectorXd& xi) const;
  void checkConditioning() const;

  std::shared_ptr<const NominalModel> nominal_;
  BasisKind basis_;
  SensitivityTerms terms_;
  int order_;  ///< of the derivatives
  Eigen::VectorXd theta_;
};

}  // namespace uncertainty_identification
