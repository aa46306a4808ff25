#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "model/filter.h"
#include "uncertainty_identification/model/block.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// Denotes a partial derivative: the sorted indices of theta to differentiate by; empty for the
/// value.
using DerivativeIndex = std::vector<int>;

/// `index` with l inserted in order.
DerivativeIndex with(DerivativeIndex index, int l);

/// The coefficients of Go = q^-delay B/A and their derivatives with respect to theta, up to the
/// third, at one theta. First derivatives are the model's Jacobian; higher ones are finite
/// differences of it.
class PlantCoefficients {
 public:
  PlantCoefficients(const NominalModel& nominal, const Eigen::VectorXd& theta);

  int delay() const { return delay_; }
  Eigen::Index nb() const { return nb_; }
  Eigen::Index na() const { return na_; }
  Eigen::VectorXd a() const { return value_.tail(na_); }

  /// The derivative of [b; a] (nb + na entries).
  Eigen::VectorXd derivative(const DerivativeIndex& index);

 private:
  const Eigen::MatrixXd& jacobianDerivative(const DerivativeIndex& directions);

  const NominalModel& nominal_;
  Eigen::VectorXd theta_, value_;
  int delay_;
  Eigen::Index nb_, na_;
  std::map<DerivativeIndex, Eigen::MatrixXd> jacobians_;
};

/// Derivatives of x = Go u with respect to theta; each lane may have its own theta. For every list
/// S of parameters, A x = B u implies
///   A x_S = B_S u - sum over T not empty of A_T x_(S without T),
/// where T runs over all ways to split S into T and the rest. A known start adds its coefficients
/// zeta to the first samples of A x, and nothing to those of A x_S.
class PlantDerivatives {
 public:
  /// Takes one PlantCoefficients per lane, or one for all lanes. They and `input` must outlive this
  /// object. `start` holds zeta of each lane as columns, and may be empty.
  PlantDerivatives(std::vector<PlantCoefficients>* lanes, const Signals& input,
                   Eigen::MatrixXd start = {});

  /// The derivative x_S.
  const Signals& signal(const DerivativeIndex& index);

  /// sum_k (coefficient k of A_S) q^-k x.
  Signals timesA(const DerivativeIndex& index, const Signals& x);

  /// x/A.
  void divideByA(Signals* x);

 private:
  const std::vector<Lanes>& coefficients(const DerivativeIndex& index);
  std::vector<Lanes> denominator();
  void appendTimesA(const DerivativeIndex& index, double factor, const Signals& x,
                    std::vector<DelayedSignal>* terms);

  std::vector<PlantCoefficients>* lanes_;
  const Signals& input_;
  Eigen::MatrixXd start_;
  std::map<DerivativeIndex, std::vector<Lanes>> coefficients_;
  std::map<DerivativeIndex, Signals> signals_;
};

}  // namespace uncertainty_identification
