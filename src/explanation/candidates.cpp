#include "explanation/candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "explanation/from_white_noise.h"

namespace uncertainty_identification {
namespace {

/// Takes over what is new or leads higher.
void merge(std::vector<FittedEffect> others, std::vector<FittedEffect>* candidates) {
  for (FittedEffect& other : others) {
    const auto same = std::find_if(
        candidates->begin(), candidates->end(),
        [&](const FittedEffect& candidate) { return candidate.effect == other.effect; });
    if (same == candidates->end()) {
      candidates->push_back(std::move(other));
    } else if (other.score > same->score) {
      *same = std::move(other);
    }
  }
}

}  // namespace

std::vector<FittedEffect> fittedEffects(const Fit& base, const FitData& data,
                                        const Effects& effects, const FitContext& context,
                                        bool nothing_shows) {
  constexpr std::size_t kFitted = 12, kConverged = 7, kAnew = 3;
  const double hopeless = nothing_shows ? -2 : -6;  // [nats] of predicted score
  std::vector<FittedEffect> candidates = screenedEffects(base, data, effects, context);
  const bool wrong = !candidates.empty() && candidates.front().score > 0;
  const auto leadsFar = [&](const Effect& effect) {  // a spread has been taken for the mixture's
    return movesPlant(effect) || (wrong && effect.name() == "plant_parameter_spread");
  };
  std::size_t fitted = 0;
  candidates.erase(
      std::remove_if(candidates.begin(), candidates.end(),
                     [&](const FittedEffect& candidate) {
                       if (wrong && leadsFar(*candidate.effect)) return false;
                       return (candidate.score < hopeless && !isOfMixture(*candidate.effect)) ||
                              ++fitted > kFitted;
                     }),
      candidates.end());
  inParallel(context, candidates.size(), [&](std::size_t k) {
    converge(&candidates[k], afterPredictedStep(candidates[k], data, context), base, data, context,
             4, leadsFar(*candidates[k].effect));
  });
  for (std::size_t k = 0; wrong && k < candidates.size(); ++k) {
    if (candidates[k].effect->name() == "act_delay")  // the error model imitates short ones
      merge({fittedFromEachStart(candidates[k], base.at, base, data, context)}, &candidates);
  }
  if (wrong) merge(fittedFromWhiteNoise(base, data, effects, context), &candidates);
  sortByScore(&candidates);
  inParallel(context, std::min(kConverged, candidates.size()), [&](std::size_t k) {
    converge(&candidates[k], candidates[k].fit, base, data, context, 15, wrong && k < kAnew);
  });
  sortByScore(&candidates);
  return candidates;
}

FittedEffect oneMoreComponent(const Fit& base, const FitData& data,
                              const std::shared_ptr<const Effect>& effect,
                              const FitContext& context) {
  constexpr double kSelection = 1.5;  // [nats] for the choice among many splits
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  const int components = base.at.mixture.components(), n = base.at.mixture.dimension();
  FittedEffect candidate{effect, base, 0, kNone, {}, false};
  if (n == 0 || data.count() < 4 * (components + 1)) return candidate;
  candidate.fit = takeScoringSteps(withNewMixture(base, data, context, components + 1, 8), data,
                                   context.options, 4, 0.05);
  candidate.penalty = 0.5 * (1 + n + n * (n + 1) / 2.0) * std::log(data.count()) + kSelection;
  candidate.score = candidate.fit.log_likelihood - base.log_likelihood - candidate.penalty;
  for (const double weight : candidate.fit.at.mixture.weights)
    if (weight * data.count() < 2) candidate.score = kNone;
  return candidate;
}

}  // namespace uncertainty_identification
