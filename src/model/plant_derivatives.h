#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "uncertainty_identification/model/block.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// Which derivative: a sorted list of indices of theta, empty for the value.
using DerivativeIndex = std::vector<int>;

/// `index` with l put in its place.
DerivativeIndex with(DerivativeIndex index, int l);

/// The coefficients of Go = q^-delay B/A at one theta and their derivatives to it, up to the third.
/// The first are the model's Jacobian, the others differences of it.
class PlantCoefficients {
 public:
  PlantCoefficients(const NominalModel& nominal, const Eigen::VectorXd& theta);

  int delay() const { return delay_; }
  Eigen::Index nb() const { return nb_; }
  Eigen::Index na() const { return na_; }

  /// [b; a] differentiated (nb + na).
  Eigen::VectorXd derivative(const DerivativeIndex& index);

 private:
  const Eigen::MatrixXd& jacobianDerivative(const DerivativeIndex& directions);

  const NominalModel& nominal_;
  Eigen::VectorXd theta_, value_;
  int delay_;
  Eigen::Index nb_, na_;
  std::map<DerivativeIndex, Eigen::MatrixXd> jacobians_;
};

/// Derivatives of x = Go u to theta, in each lane at a theta of its own. From A x = B u follows for
/// every list S of parameters, with S split into T and the rest in all ways,
///   A x_S = B_S u - sum over T not empty of A_T x_(S less T).
class PlantDerivatives {
 public:
  /// One PlantCoefficients per lane, or one for all; they and `input` must outlive this object.
  PlantDerivatives(std::vector<PlantCoefficients>* lanes, const Signals& input);

  /// x_S.
  const Signals& signal(const DerivativeIndex& index);

  /// q^-k summed over k with the coefficients of A_S, applied to x.
  Signals timesA(const DerivativeIndex& index, const Signals& x);

  /// x/A.
  void divideByA(Signals* x);

 private:
  const std::vector<Lanes>& coefficients(const DerivativeIndex& index);

  std::vector<PlantCoefficients>* lanes_;
  const Signals& input_;
  std::map<DerivativeIndex, std::vector<Lanes>> coefficients_;
  std::map<DerivativeIndex, Signals> signals_;
};

}  // namespace uncertainty_identification
