#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "model/model.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/model/error_basis.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// What LinearModel hands over for its fused sweep.
struct FusedInput {
  Polynomials polynomials;
  Eigen::MatrixXd jacobian;  ///< d[b; a; c; d]/dtheta; empty: no derivatives
  double common_offset = 0;  ///< of the outputs; 0 where none is estimated
  int states = 0;            ///< unknown directions of Go's initial state
};

/// The fused sweep of a Box-Jenkins model with FIR error basis, of any orders. What depends on the
/// parameters alone, like the columns of unknown initial values, is computed here, once for all
/// blocks. The samples are then swept twice: the first sweep estimates the initial values and ends
/// where their effect has vanished; the second one starts from them. Null if the options need the
/// general path: columns are not the same for all experiments, or signals at the input are unknown.
std::unique_ptr<const FusedSweep> fusedBoxJenkins(const FusedInput& input, const ErrorBasis& basis,
                                                  const EstimationOptions& options,
                                                  const std::vector<Block>& blocks);

}  // namespace uncertainty_identification
