#pragma once

#include <vector>

#include "estimation/least_squares_start.h"
#include "uncertainty_identification/model/error_basis.h"

namespace uncertainty_identification {

/// Starts for Go under an FIR error model: Go (1 + GDelta(eta_r)) has the numerator
/// B_r = B (1 + sum_k eta_rk q^-k), so that the experiments' own numerators, estimated with a
/// common A, are B's multiples in few directions. Alternating least squares on B and xi_r, from
/// several means of xi, finds B where a pooled fit finds B (1 + GDelta(mean xi)), whose likelihood
/// has a maximum of its own. Best first, at most two; none for other bases or fewer than three
/// complete experiments.
std::vector<LeastSquaresModel> embeddedStarts(const ErrorBasis& basis, const Polynomials& sizes,
                                              const std::vector<Experiment>& experiments,
                                              bool with_constant);

}  // namespace uncertainty_identification
