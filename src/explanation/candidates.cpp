#include "candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "screening.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kNone = -std::numeric_limits<double>::infinity();

double penaltyOf(const Effect& effect, const FitData& data) {
  const double parameters = effect.parameterCount();
  const double each = isOfMixture(effect) ? std::log(data.count()) : std::log(data.samples());
  const double starts =
      static_cast<double>(std::max<std::size_t>(1, effect.description().starts.size()));
  return 0.5 * parameters * each + std::log(starts);
}

FittedEffect screened(const Screening& screening, const std::shared_ptr<const Effect>& effect,
                      const FitData& data) {
  Screening::Start start = screening.best(effect);
  FittedEffect candidate{effect, std::move(start.fit), penaltyOf(*effect, data), 0, {}, false};
  candidate.score = start.gain - candidate.penalty;
  candidate.step = std::move(start.step);
  return candidate;
}

/// The candidate at its start, or moved by the predicted step or part of it, psi within its bounds:
/// a gain of the wrong sign would not be climbed away from.
Fit approached(const FittedEffect& candidate, const FitData& data, const FitContext& context) {
  constexpr int kMixtureSteps = 5;
  Fit best = evaluated(candidate.fit.model, candidate.fit.at, data);
  if (candidate.step.size() == 0) return best;
  const auto& parameters = candidate.effect->description().parameters;
  for (const double share : {1.0, 0.4}) {
    ModelParameters at = candidate.fit.at;
    at.parameters += share * candidate.step;
    auto psi = at.parameters.tail(static_cast<Index>(parameters.size()));
    for (std::size_t i = 0; i < parameters.size(); ++i)
      psi[static_cast<Index>(i)] =
          std::clamp(psi[static_cast<Index>(i)], parameters[i].lower, parameters[i].upper);
    Fit there = mixtureFitted(candidate.fit.model, at, data, context.options, kMixtureSteps);
    if (there.log_likelihood > best.log_likelihood) best = std::move(there);
  }
  return best;
}

void converge(FittedEffect* candidate, Fit fit, const Fit& base, const FitData& data,
              const FitContext& context, int steps, bool anew) {
  fit = improved(std::move(fit), data, context.options, steps, 0.05);
  if (anew) fit = withNewStart(fit, data, context, steps);
  candidate->started_anew = candidate->started_anew || anew;
  if (steps > 5) fit = searched(std::move(fit), data, context);
  candidate->fit = std::move(fit);
  candidate->score = candidate->fit.log_likelihood - base.log_likelihood - candidate->penalty;
}

void sortByScore(std::vector<FittedEffect>* candidates) {
  std::stable_sort(
      candidates->begin(), candidates->end(),
      [](const FittedEffect& left, const FittedEffect& right) { return left.score > right.score; });
}

}  // namespace

bool isOfNoise(const Effect& effect) {
  return effect.name().rfind("noise_", 0) == 0 || effect.name() == "sens_outliers";
}

bool isOfMixture(const Effect& effect) {
  return effect.name() == "exp_mode" || effect.name() == "plant_aging";
}

std::vector<FittedEffect> fittedEffects(const Fit& base, const FitData& data,
                                        const Effects& effects, const FitContext& context,
                                        bool nothing_shows) {
  constexpr std::size_t kFitted = 12, kConverged = 7, kAnew = 3;
  const double hopeless = nothing_shows ? -2 : -6;  // [nats] of predicted score
  const Screening screening(base, data, context.options);
  std::vector<FittedEffect> candidates(effects.size());
  const auto inParallel = [&](std::size_t count, const std::function<void(std::size_t)>& task) {
    context.pool->forEach(static_cast<int>(count), [&](int k) {
      if (context.going_on()) task(static_cast<std::size_t>(k));
    });
  };
  inParallel(effects.size(),
             [&](std::size_t k) { candidates[k] = screened(screening, effects[k], data); });
  sortByScore(&candidates);
  const bool wrong = !candidates.empty() && candidates.front().score > 0;
  const auto leadsFar = [&](const Effect& effect) {  // a spread has been taken for the mixture's
    return movesPlant(effect) || (wrong && effect.name() == "plant_parameter_spread");
  };
  std::size_t fitted = 0;
  candidates.erase(
      std::remove_if(candidates.begin(), candidates.end(),
                     [&](const FittedEffect& candidate) {
                       if (candidate.effect == nullptr) return true;
                       if (wrong && leadsFar(*candidate.effect)) return false;
                       return (candidate.score < hopeless && !isOfMixture(*candidate.effect)) ||
                              ++fitted > kFitted;
                     }),
      candidates.end());
  inParallel(candidates.size(), [&](std::size_t k) {
    converge(&candidates[k], approached(candidates[k], data, context), base, data, context, 4,
             leadsFar(*candidates[k].effect));
  });
  sortByScore(&candidates);
  inParallel(std::min(kConverged, candidates.size()), [&](std::size_t k) {
    converge(&candidates[k], candidates[k].fit, base, data, context, 15, wrong && k < kAnew);
  });
  sortByScore(&candidates);
  return candidates;
}

FittedEffect oneMoreComponent(const Fit& base, const FitData& data,
                              const std::shared_ptr<const Effect>& effect,
                              const FitContext& context) {
  constexpr double kSelection = 1.5;  // [nats] for the choice among many splits
  const int components = base.at.mixture.components(), n = base.at.mixture.dimension();
  FittedEffect candidate{effect, base, 0, kNone, {}, false};
  if (n == 0 || data.count() < 4 * (components + 1)) return candidate;
  candidate.fit = improved(withNewMixture(base, data, context, components + 1, 8), data,
                           context.options, 4, 0.05);
  candidate.penalty = 0.5 * (1 + n + n * (n + 1) / 2.0) * std::log(data.count()) + kSelection;
  candidate.score = candidate.fit.log_likelihood - base.log_likelihood - candidate.penalty;
  for (const double weight : candidate.fit.at.mixture.weights)
    if (weight * data.count() < 2) candidate.score = kNone;
  return candidate;
}

}  // namespace uncertainty_identification
