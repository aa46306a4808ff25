#pragma once

#include <Eigen/Core>

#include "uncertainty_identification/model/block.h"

/// Rational filters on all lanes of a block, from rest: the only loops over samples outside the fused kernel.
namespace uncertainty_identification {

/// out = q^-delay (n0 + n1 q^-1 + ...)/(1 + d1 q^-1 + ...) in. `out` may not be `in`.
void filter(const Eigen::VectorXd& numerator, const Eigen::VectorXd& monic_denominator, int delay, const Signals& in,
            Signals* out);

/// out = q^-delay in.
void shift(int delay, const Signals& in, Signals* out);

/// out += factor q^-delay in.
void addShifted(double factor, int delay, const Signals& in, Signals* out);

/// Sum over samples of left right, per lane.
Lanes dot(const Signals& left, const Signals& right);

}  // namespace uncertainty_identification
