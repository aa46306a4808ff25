#include "explanation/candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "explanation/from_white_noise.h"
#include "math/information_criterion.h"

namespace uncertainty_identification {
namespace {

/// Adds the others to the candidates; of two candidates for one effect the one with the higher
/// score is kept.
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

/// Effects whose fit must restart theta and the mixture: those that move theta far, and those that
/// the mixture of the base may have absorbed. The latter only if the screening predicts that some
/// effect gains.
bool needsRestart(const Effect& effect, bool some_gain) {
  return effect.has(Trait::moves_plant) || (some_gain && effect.has(Trait::in_mixture));
}

/// Keeps the candidates, ordered by screening score, that are worth fitting.
void keepPromising(bool checks_pass, bool some_gain, std::vector<FittedEffect>* candidates) {
  constexpr std::size_t kMost = 12;
  // The screening is only approximate. Where the checks fail, an effect may turn out to gain though
  // a loss was predicted.
  const double least_score = checks_pass ? -2 : -6;  // [nats]
  std::size_t kept = 0;
  const auto hopeless = [&](const FittedEffect& candidate) {
    if (some_gain && needsRestart(*candidate.effect, some_gain)) return false;
    return (candidate.score < least_score && !isOfMixture(*candidate.effect)) || ++kept > kMost;
  };
  candidates->erase(std::remove_if(candidates->begin(), candidates->end(), hopeless),
                    candidates->end());
}

/// Where the search was cancelled or ran out of time, some candidates were screened and not fitted.
void keepFitted(std::vector<FittedEffect>* candidates) {
  candidates->erase(std::remove_if(candidates->begin(), candidates->end(),
                                   [](const FittedEffect& each) {
                                     return !each.fit.model || each.fit.of_experiments.size() == 0;
                                   }),
                    candidates->end());
}

void reportFitted(const std::vector<FittedEffect>& candidates, std::size_t k, std::size_t count,
                  const FitContext& context) {
  context.report_fitted(candidates[k].effect->label() + ", " + std::to_string(k + 1) + " of " +
                        std::to_string(count));
}

}  // namespace

std::vector<FittedEffect> fittedEffects(const Fit& base, const FitData& data,
                                        const Effects& effects, const FitContext& context,
                                        bool checks_pass) {
  constexpr std::size_t kConverged = 7, kRestarted = 3;
  std::vector<FittedEffect> candidates = screenedEffects(base, data, effects, context);
  const bool some_gain = !candidates.empty() && candidates.front().score > 0;
  keepPromising(checks_pass, some_gain, &candidates);
  inParallel(context, candidates.size(), [&](std::size_t k) {
    reportFitted(candidates, k, candidates.size(), context);
    FitEffort few_steps;
    few_steps.steps = 4;
    few_steps.restart = needsRestart(*candidates[k].effect, some_gain);
    converge(&candidates[k], afterPredictedStep(candidates[k], data, context), base, data, context,
             few_steps);
  });
  if (!context.going_on()) keepFitted(&candidates);
  // A short delay is hidden from the screening, as the error model imitates it.
  for (std::size_t k = 0; some_gain && k < candidates.size(); ++k) {
    if (candidates[k].effect->has(Trait::many_optima))
      merge({fittedFromEachStart(candidates[k], base.at, base, data, context)}, &candidates);
  }
  if (some_gain) merge(fittedFromWhiteNoise(base, data, effects, context), &candidates);
  sortByScore(&candidates);
  const std::size_t best = std::min(kConverged, candidates.size());
  inParallel(context, best, [&](std::size_t k) {
    reportFitted(candidates, k, best, context);
    FitEffort to_convergence;
    to_convergence.steps = 15;
    to_convergence.restart = some_gain && k < kRestarted;
    to_convergence.search_grid = true;
    converge(&candidates[k], candidates[k].fit, base, data, context, to_convergence);
  });
  if (!context.going_on()) keepFitted(&candidates);
  sortByScore(&candidates);
  return candidates;
}

FittedEffect oneMoreComponent(const Fit& base, const FitData& data,
                              const std::shared_ptr<const Effect>& effect,
                              const FitContext& context) {
  constexpr double kSelection = 1.5;  // [nats] for the choice among many ways to split the mixture
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  constexpr int kFewestExperiments = 4;  // per component
  constexpr int kRestarts = 8, kSteps = 4;
  constexpr double kTolerance = 0.05;  // [nats]
  const int components = base.at.mixture.components(), n = base.at.mixture.dimension();
  FittedEffect candidate{effect, base, 0, kNone, {}, false};
  if (n == 0 || data.count() < kFewestExperiments * (components + 1)) return candidate;
  candidate.fit = takeScoringSteps(withNewMixture(base, data, context, components + 1, kRestarts),
                                   data, context.options, kSteps, kTolerance);
  const double parameters = 1 + n + n * (n + 1) / 2.0;  // weight, mean, covariance
  candidate.penalty = bicPenalty(parameters, data.count()) + kSelection;
  candidate.score = candidate.fit.log_likelihood - base.log_likelihood - candidate.penalty;
  for (const double weight : candidate.fit.at.mixture.weights)
    if (weight * data.count() < 2) candidate.score = kNone;
  return candidate;
}

}  // namespace uncertainty_identification
