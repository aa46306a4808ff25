#pragma once

#include <Eigen/Core>
#include <vector>

#include "uncertainty_identification/model/block.h"

/// Rational filters on all lanes of a block, from rest: the only loops over samples outside the
/// fused kernel.
namespace uncertainty_identification {

/// out = q^-delay (n0 + n1 q^-1 + ...)/(1 + d1 q^-1 + ...) in. `out` may not be `in`.
void filter(const Eigen::VectorXd& numerator, const Eigen::VectorXd& monic_denominator, int delay,
            const Signals& in, Signals* out);

/// out = q^-delay in.
void shift(int delay, const Signals& in, Signals* out);

/// out += factor q^-delay in.
void addShifted(double factor, int delay, const Signals& in, Signals* out);

/// Inner products over the samples, per lane: sums(i, j) = left_i'right_j, stored at [i
/// right.size() + j]. A null signal stands for zero. Runs through the samples in pieces that stay
/// in the cache.
std::vector<Lanes> innerProducts(const std::vector<const Signals*>& left,
                                 const std::vector<const Signals*>& right);

}  // namespace uncertainty_identification
