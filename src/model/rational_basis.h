#pragma once

#include <Eigen/Core>
#include <vector>

#include "uncertainty_identification/model/error_basis.h"

namespace uncertainty_identification {

/// The filters sum_k T_ki F_k, i = 1..n, of the error model as rational functions of q^-1.
struct RationalBasis {
  explicit RationalBasis(const ErrorBasis& basis);

  std::vector<Eigen::VectorXd> numerators;  ///< n of them, over the common denominator
  Eigen::VectorXd denominator;              ///< monic, without the leading 1
  int taps = 0;
};

}  // namespace uncertainty_identification
