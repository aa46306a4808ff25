#pragma once

#include <vector>

#include "estimation/least_squares_start.h"
#include "uncertainty_identification/model/error_basis.h"

namespace uncertainty_identification {

/// Starting values for Go under an FIR error model. The experiments differ in the numerator B_r = B
/// (1 + sum_k eta_rk q^-k) only. So numerators are estimated for each experiment with a common A,
/// and then factorised into B and xi_r by alternating least squares, starting from several means of
/// xi. A fit of one numerator to all experiments would give B (1 + GDelta(mean xi)) instead of B,
/// and the likelihood has a local maximum there. Returns at most two starts, best first; none for
/// other bases or fewer than three complete experiments.
std::vector<LeastSquaresModel> embeddedStarts(const ErrorBasis& basis, const Polynomials& sizes,
                                              const std::vector<Experiment>& experiments,
                                              bool with_constant);

}  // namespace uncertainty_identification
