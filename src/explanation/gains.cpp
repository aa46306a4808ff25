#include "gains.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "refine.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// The fit without effect k of its model, before it is fitted again.
Fit without(const Fit& fit, std::size_t k, const FitData& data) {
  Effects effects = fit.model->effects();
  const Index first = fit.model->offsetOf(k), count = effects[k]->parameterCount();
  effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(k));
  ModelParameters at = fit.at;
  const Index after = at.parameters.size() - first - count;
  at.parameters.segment(first, after) = at.parameters.tail(after).eval();
  at.parameters.conservativeResize(at.parameters.size() - count);
  return evaluated(fit.model->with(effects), at, data);
}

/// Log density that a candidate adds to each experiment held out.
VectorXd densityGained(const SearchState& base, const FittedEffect& candidate) {
  if (!isOfTails(*candidate.effect))
    return logDensities(candidate.fit, base.held) - logDensities(base.fit, base.held);
  const Tails tails = tailsOf(base.fit, base.train, residualsOf(base.fit, base.train));
  const Fit there = judged(base.fit, base.held);
  if (!std::isfinite(there.log_likelihood))
    return VectorXd::Constant(base.held.count(), std::nan(""));
  return tailGain(tails, lawOf(*candidate.effect), residualsOf(there, base.held), base.held);
}

}  // namespace

Fit fittedWithout(const Fit& fit, std::size_t k, const FitData& data, const FitContext& context) {
  return polished(improved(without(fit, k, data), data, context.options, 10, 0.05), data, context);
}

TriedEffect triedEffect(const SearchState& base, const FittedEffect& candidate) {
  const EffectDescription& of = candidate.effect->description();
  TriedEffect tried{of.name, of.variant, candidate.score, std::nan(""), std::nan("")};
  if (candidate.score > 0)
    std::tie(tried.held_out_gain, tried.standard_error) =
        meanWithError(densityGained(base, candidate));
  return tried;
}

void measureAnew(const SearchState& base, const FitContext& context, SearchState* found) {
  Fit after = found->fit;
  HeldOut held_after = heldOut(after, found->held);
  for (auto cause = found->causes.rbegin(); cause != found->causes.rend(); ++cause) {
    const Effects& effects = after.model->effects();
    const auto at = std::find(effects.begin(), effects.end(), cause->effect);
    if (at == effects.end()) continue;
    const bool is_base =
        effects.size() == 1 && after.at.mixture.components() == base.fit.at.mixture.components();
    const Fit before = is_base
                           ? evaluated(base.fit.model, base.fit.at, found->train)
                           : fittedWithout(after, static_cast<std::size_t>(at - effects.begin()),
                                           found->train, context);
    const HeldOut held_before = heldOut(before, found->held);
    cause->score = after.log_likelihood - before.log_likelihood - cause->penalty;
    cause->gain = gainOf(held_before, held_after, VectorXd::Zero(found->held.count()));
    after = before;
    held_after = held_before;
  }
}

}  // namespace uncertainty_identification
