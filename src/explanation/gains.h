#pragma once

#include "explanation/search.h"

/// What candidates and accepted causes gain on held-out experiments.
namespace uncertainty_identification {

/// The model of a fit without its effect k, fitted to convergence.
Fit fittedWithout(const Fit& fit, std::size_t k, const FitData& data, const FitContext& context);

/// The result of a candidate for the report. Its held-out gain is computed only if the score is
/// positive.
TriedEffect triedEffect(const SearchState& base, const FittedEffect& candidate);

/// Gains of log density of a residual distribution over a Gaussian one.
PairedGains distributionGains(const SearchState& state, DistributionFamily family);

/// Computes score and gain of each cause again, each on top of the causes before it. Those measured
/// when a cause was accepted no longer hold once another cause was removed. Causes outside the
/// chain of signals are left as they are.
void remeasureGains(const SearchState& base, const FitContext& context, SearchState* found);

/// Tells which experiments are held out, and how well the model without causes simulates them; a
/// warning where none could be.
void describeHeldOut(const SearchState& base, Explanation* explanation);

}  // namespace uncertainty_identification
