#pragma once

#include <Eigen/Core>

#include "model/statistics.h"
#include "uncertainty_identification/model/block.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// The statistics of a Box-Jenkins model with FIR error basis, from rest and without gaps, in one
/// loop over the samples that keeps every signal in registers. `jacobian` maps polynomial
/// coefficients to theta (empty: no derivatives). Returns false, doing nothing, for orders beyond
/// those compiled (4) or n beyond 2.
bool fusedBoxJenkins(const Block& block, const Polynomials& polynomials, const Eigen::MatrixXd& T,
                     const Eigen::MatrixXd& jacobian, Statistics* statistics);

}  // namespace uncertainty_identification
