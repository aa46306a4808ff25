#pragma once

#include <Eigen/Core>
#include <vector>

#include "uncertainty_identification/model/block.h"

/// Rational filters applied to all lanes of a block, from rest. Apart from the fused kernel
/// (fused_sweep.h), these are the only loops over samples.
namespace uncertainty_identification {

/// out = q^-delay (n0 + n1 q^-1 + ...)/(1 + d1 q^-1 + ...) in. `out` and `in` must be different.
void filter(const Eigen::VectorXd& numerator, const Eigen::VectorXd& monic_denominator, int delay,
            const Signals& in, Signals* out);

/// out = q^-delay in.
void shift(int delay, const Signals& in, Signals* out);

/// out += factor q^-delay in.
void addShifted(double factor, int delay, const Signals& in, Signals* out);

/// A delayed signal times a factor of its own in each lane.
struct DelayedSignal {
  const Signals* signal;
  Lanes factor;
  int delay;
};

/// x <- (x + sum of the terms)/A, with A = 1 + a1 q^-1 + ... of each lane. The signals are as long
/// as x. One loop does it all, because the memory that it reads takes the time.
void filterSum(const std::vector<DelayedSignal>& terms, const std::vector<Lanes>& a, Signals* x);

/// Inner products over the samples, for each lane: left_i'right_j is stored at [i right.size() +
/// j]. A null pointer stands for a zero signal, and a signal that is shorter than the others is
/// zero beyond its end. Proceeds in pieces of the samples that fit the cache.
std::vector<Lanes> innerProducts(const std::vector<const Signals*>& left,
                                 const std::vector<const Signals*>& right);

}  // namespace uncertainty_identification
