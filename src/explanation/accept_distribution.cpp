#include <cmath>

#include "explanation/acceptance.h"
#include "explanation/confidence.h"
#include "explanation/gains.h"
#include "explanation/search.h"

namespace uncertainty_identification {

void Search::banDistributions(SearchState* state) const {
  for (const Trait trait : {Trait::heavy_tails, Trait::outliers})
    state->banned.push_back(findEffect(catalogue_, trait)->name());
}

/// Accepts a residual distribution if the held-out experiments confirm it. Outliers are then masked
/// in all experiments, and the model is fitted again.
bool Search::acceptDistribution(SearchState* state, const FittedEffect& best) {
  const Residuals residuals = residualsOf(state->fit, state->train);
  const ResidualDistribution distribution =
      residualDistribution(state->fit, state->train, residuals);
  if (!distribution.isOfNoise()) {
    banDistributions(state);
    return false;
  }
  const DistributionFamily family = familyOf(*best.effect);
  FoundCause cause{best.effect, best.score, best.penalty, 1, {}, false, {}, {}};
  const Fit on_held = evaluateOn(state->fit, state->held);
  if (std::isfinite(on_held.log_likelihood)) {
    const Residuals residuals_held = residualsOf(on_held, state->held);
    const HeldOut before = heldOut(state->fit, state->held);
    const PairedGains gains = distributionGains(*state, family);
    cause.gain = gainOf(before, before, gains);
    Evidence evidence{best.score, Eigen::VectorXd(gains.held.size() + gains.training.size())};
    evidence.gains << gains.held, gains.training;
    cause.confidence = confidenceOf(evidence, {});
    if (!passes(*cause.gain, acceptanceRule(*best.effect, best.score))) return false;
    const ResidualDistribution of_held = residualDistribution(on_held, state->held, residuals_held);
    state->held = FitData(withoutOutliers(state->held, residuals_held, of_held));
  }
  if (family == DistributionFamily::student) {
    cause.parameters = {{"degrees_of_freedom", "1", distribution.degrees, std::nan(""),
                         std::nan(""), std::nan("")}};
  } else {
    cause.parameters = {
        {"share", "1", distribution.share, std::nan(""), std::nan(""), std::nan("")},
        {"ratio", "1", distribution.ratio, std::nan(""), std::nan(""), std::nan("")}};
  }
  if (distribution.mayBeReadings()) cause.equivalent = best.effect->description().equivalent;
  state->train = FitData(withoutOutliers(state->train, residuals, distribution));
  state->fit = optimiseWithRestarts(evaluated(state->fit.model, state->fit.at, state->train),
                                    state->train, context_);
  if (cause.gain) cause.gain->noise_variance.after = state->fit.at.noise_variance;
  state->causes.push_back(std::move(cause));
  banDistributions(state);
  state->law = ResidualLaw::heavy_tails;
  state->total += best.score;
  return true;
}

}  // namespace uncertainty_identification
