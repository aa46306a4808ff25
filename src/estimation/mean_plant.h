#pragma once

#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/model/nominal_model.h"

/// The plant in the middle of a distribution of plants, which is the one to simulate.
namespace uncertainty_identification {

/// Go (1 + GDelta) with the FIR filter eta = T xi: the plant itself where that is zero.
Polynomials filteredPlant(Polynomials plant, const Eigen::MatrixXd& T, const Eigen::VectorXd& xi);

/// The estimate's Go (1 + GDelta) at the mean of the error parameters: Go, unless the error model
/// is FIR and its mean is free. Without noise model.
Polynomials meanPlant(const Estimate& estimate);

}  // namespace uncertainty_identification
