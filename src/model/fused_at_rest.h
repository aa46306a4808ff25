#pragma once

#include <Eigen/Core>

#include "model/statistics.h"
#include "uncertainty_identification/model/block.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// The statistics of a Box-Jenkins model with FIR error basis, from rest and without gaps, in a
/// single loop over the samples that keeps all signals in registers: the fastest case of
/// fused_statistics.h. `jacobian` is d[b; a; c; d]/dtheta (empty: no derivatives). Returns false
/// and does nothing if the orders exceed those compiled (4) or n exceeds 2.
bool fusedAtRest(const Block& block, const Polynomials& polynomials, const Eigen::MatrixXd& T,
                 const Eigen::MatrixXd& jacobian, Statistics* statistics);

}  // namespace uncertainty_identification
