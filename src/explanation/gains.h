#pragma once

#include "explanation/search.h"

/// What candidates and causes gain.
namespace uncertainty_identification {

/// A fit without effect k of its model, fitted again.
Fit fittedWithout(const Fit& fit, std::size_t k, const FitData& data, const FitContext& context);

/// A candidate with what it gains on the experiments held out, where it has a score.
TriedEffect triedEffect(const SearchState& base, const FittedEffect& candidate);

/// What a law of the residuals gains.
PairedGains distributionGains(const SearchState& state, ResidualLaw law);

/// Score and gain of each cause in the chain on top of those before it, anew: what was measured
/// when it was taken in no longer holds once another was taken out.
void remeasureGains(const SearchState& base, const FitContext& context, SearchState* found);

}  // namespace uncertainty_identification
