#include "explanation/gains.h"

#include <algorithm>
#include <cmath>

#include "explanation/refine.h"
#include "explanation/warnings.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// The model of a fit without its effect k, the other parameters unchanged.
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

/// Gains of log density of a candidate over the base.
PairedGains gainsOf(const SearchState& base, const FittedEffect& candidate) {
  if (!isResidualDistribution(*candidate.effect)) return base.gains(base.fit, candidate.fit);
  return distributionGains(base, familyOf(*candidate.effect));
}

}  // namespace

PairedGains distributionGains(const SearchState& state, DistributionFamily family) {
  const Residuals residuals = residualsOf(state.fit, state.train);
  const ResidualDistribution distribution = residualDistribution(state.fit, state.train, residuals);
  const Fit there = evaluateOn(state.fit, state.held);
  if (!std::isfinite(there.log_likelihood))
    return {VectorXd::Constant(state.held.count(), std::nan("")), {}};
  PairedGains gains{
      distributionGain(distribution, family, residualsOf(there, state.held), state.held), {}};
  if (!state.fitted_to)
    gains.training = distributionGain(distribution, family, residuals, state.train);
  return gains;
}

Fit fittedWithout(const Fit& fit, std::size_t k, const FitData& data, const FitContext& context) {
  return optimiseWithRestarts(
      takeScoringSteps(without(fit, k, data), data, context.options, 10, 0.05), data, context);
}

TriedEffect triedEffect(const SearchState& base, const FittedEffect& candidate) {
  const EffectDescription& of = candidate.effect->description();
  TriedEffect tried{of.name, of.variant, candidate.score, std::nan(""), std::nan("")};
  if (candidate.score > 0) {
    const MeanGain gain = meanGain(gainsOf(base, candidate));
    tried.held_out_gain = gain.value;
    tried.standard_error = gain.standard_error;
  }
  return tried;
}

void remeasureGains(const SearchState& base, const FitContext& context, SearchState* found) {
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
    cause->gain = gainOf(held_before, held_after, found->gains(before, after));
    after = before;
    held_after = held_before;
  }
}

void describeHeldOut(const SearchState& base, Explanation* explanation) {
  if (base.fitted_to) {
    explanation->warnings.push_back(kNothingHeldOut);
    return;
  }
  for (const Experiment& experiment : base.held.experiments())
    explanation->held_out.push_back(experiment.id);
  double fit = heldOut(base.fit, base.held).nrmse_fit_percent;
  if (explanation->before.configuration.estimation.offsets == Offsets::per_experiment)
    fit = 100 - (100 - fit) * spreadOfLevels(base.held.experiments());
  if (std::isfinite(fit)) explanation->held_out_fit = fit;
}

}  // namespace uncertainty_identification
