#include "explanation/fitted_effect.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "explanation/screening.h"
#include "math/information_criterion.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;

double penaltyOf(const Effect& effect, const FitData& data) {
  const double parameters = effect.parameterCount();
  const double observations = isOfMixture(effect) ? data.count() : data.samples();
  const double starts =
      static_cast<double>(std::max<std::size_t>(1, effect.description().starts.size()));
  return bicPenalty(parameters, observations) + std::log(starts);
}

FittedEffect screened(const Screening& screening, const std::shared_ptr<const Effect>& effect,
                      const FitData& data) {
  Screening::Start start = screening.best(effect);
  FittedEffect candidate{effect, std::move(start.fit), penaltyOf(*effect, data), 0, {}, false};
  candidate.score = start.gain - candidate.penalty;
  candidate.step = std::move(start.step);
  return candidate;
}

}  // namespace

bool isOfNoise(const Effect& effect) {
  return effect.stage() == Stage::noise || effect.has(Trait::of_noise);
}

bool isOfMixture(const Effect& effect) { return effect.has(Trait::of_mixture); }

Fit afterPredictedStep(const FittedEffect& candidate, const FitData& data,
                       const FitContext& context) {
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
              const FitContext& context, const FitEffort& effort) {
  constexpr double kTolerance = 0.05;  // [nats]
  fit = takeScoringSteps(std::move(fit), data, context.options, effort.steps, kTolerance);
  if (effort.restart) fit = withNewStart(fit, data, context, effort.steps);
  candidate->restarted = candidate->restarted || effort.restart;
  if (effort.search_grid) fit = searchGrid(std::move(fit), data, context);
  candidate->fit = std::move(fit);
  candidate->score = candidate->fit.log_likelihood - base.log_likelihood - candidate->penalty;
}

FittedEffect fittedFromEachStart(const FittedEffect& screened, const ModelParameters& from,
                                 const Fit& base, const FitData& data, const FitContext& context) {
  constexpr int kMixtureSteps = 5;
  FitEffort few_steps;
  few_steps.steps = 4;
  const std::vector<Eigen::VectorXd>& starts = screened.effect->description().starts;
  std::vector<FittedEffect> all(starts.size(), screened);
  for (FittedEffect& each : all) each.score = -std::numeric_limits<double>::infinity();
  inParallel(context, starts.size(), [&](std::size_t k) {
    ModelParameters at = from;
    at.parameters.conservativeResize(from.parameters.size() + starts[k].size());
    at.parameters.tail(starts[k].size()) = starts[k];
    converge(&all[k], mixtureFitted(screened.fit.model, at, data, context.options, kMixtureSteps),
             base, data, context, few_steps);
  });
  sortByScore(&all);
  return all.front();
}

void sortByScore(std::vector<FittedEffect>* candidates) {
  std::stable_sort(
      candidates->begin(), candidates->end(),
      [](const FittedEffect& left, const FittedEffect& right) { return left.score > right.score; });
}

void inParallel(const FitContext& context, std::size_t count,
                const std::function<void(std::size_t)>& task) {
  context.pool->forEach(static_cast<int>(count), [&](int k) {
    if (context.going_on()) task(static_cast<std::size_t>(k));
  });
}

std::vector<FittedEffect> screenedEffects(const Fit& base, const FitData& data,
                                          const Effects& effects, const FitContext& context) {
  const Screening screening(base, data, context.options);
  std::vector<FittedEffect> candidates(effects.size());
  inParallel(context, effects.size(),
             [&](std::size_t k) { candidates[k] = screened(screening, effects[k], data); });
  const auto left_out = [](const FittedEffect& candidate) { return candidate.effect == nullptr; };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), left_out),
                   candidates.end());
  sortByScore(&candidates);
  return candidates;
}

}  // namespace uncertainty_identification
