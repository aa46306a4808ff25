#include "candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "screening.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/estimation/initial_guess.h"
#include "uncertainty_identification/estimation/least_squares_start.h"
#include "uncertainty_identification/model/filter.h"

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

/// Experiments whose input has passed the effects ahead of a linear plant, so that least squares
/// can start theta anew.
std::vector<Experiment> withDrivenInput(const Fit& fit, const FitData& data) {
  std::vector<Experiment> experiments = data.experiments();
  for (const Block& block : data.blocks()) {
    const Signals u = fit.model->drivingInput(block, fit.at.parameters);
    for (int lane = 0; lane < block.lanes; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      experiments[static_cast<std::size_t>(block.index[at])].u =
          u.row(lane).head(block.lengths[at]).transpose();
    }
  }
  return experiments;
}

/// Theta started anew by least squares, given the effects; kept if it leads higher.
Fit withNewPlant(const Fit& fit, const FitData& data, const FitContext& context, int steps) {
  const NominalModel& nominal = fit.model->nominal();
  const Index own = nominal.parameterCount();
  Polynomials p = nominal.polynomials(fit.at.parameters.head(own));
  const std::vector<Experiment> driven = withDrivenInput(fit, data);
  std::vector<const Experiment*> list;
  for (const Experiment& experiment : driven) list.push_back(&experiment);
  try {
    const LeastSquaresModel start =
        LeastSquaresStart(list, false, 20000)
            .steiglitzMcBride(static_cast<int>(p.b.size()), static_cast<int>(p.a.size()), p.delay,
                              p.delay);
    p.b = start.polynomials.b;
    p.a = start.polynomials.a;
    Fit fresh = fit;
    fresh.at.parameters.head(own) = nominal.fromPolynomials(p);
    fresh = improved(evaluated(fresh.model, fresh.at, data), data, context.options, steps, 0.05);
    return fresh.log_likelihood > fit.log_likelihood ? fresh : fit;
  } catch (const Error&) {  // a model without polynomials to start from, or a singular regression
    return fit;
  }
}

Fit withNewMixture(const Fit& fit, const FitData& data, const FitContext& context, int components,
                   int restarts) {
  const Likelihood likelihood(*fit.model, data.blocks(), data.count(), 1);
  const Statistics statistics = likelihood.statistics(fit.at.parameters, false);
  ModelParameters single = fit.at;
  single.mixture = {{1.0}, {fit.at.mixture.mean()}, {fit.at.mixture.covariance()}};
  ClimbOptions options = context.options;
  options.floor = covarianceFloor(single.mixture);
  double reached = 0;
  const ModelParameters at = spreadComponents(likelihood, statistics, single, components, restarts,
                                              context.seed, options, &reached);
  return evaluated(fit.model, at, data);
}

/// Whether theta may lie far from where it was without the effect.
bool movesPlant(const Effect& effect) {
  return effect.name() == "act_delay" || effect.name() == "plant_pole" ||
         effect.name() == "sens_lag";
}

FittedEffect screened(const Screening& screening, const std::shared_ptr<const Effect>& effect,
                      const Fit& base, const FitData& data) {
  Screening::Start start = screening.best(effect);
  FittedEffect candidate{effect, std::move(start.fit), penaltyOf(*effect, data), 0};
  candidate.score = start.gain - candidate.penalty;
  (void)base;
  return candidate;
}

void converge(FittedEffect* candidate, const Fit& base, const FitData& data,
              const FitContext& context, int steps) {
  Fit fit = improved(std::move(candidate->fit), data, context.options, steps, 0.05);
  if (movesPlant(*candidate->effect)) fit = withNewPlant(fit, data, context, steps);
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

bool isOfMixture(const Effect& effect) {
  return effect.name() == "exp_mode" || effect.name() == "plant_aging";
}

Fit polished(Fit fit, const FitData& data, const FitContext& context) {
  constexpr int kRounds = 5, kSteps = 12;
  for (int round = 0; round < kRounds; ++round) {
    Fit next = improved(fit, data, context.options, kSteps, 0.01);
    const double gain = next.log_likelihood - fit.log_likelihood;
    if (gain > 0) fit = std::move(next);
    if (gain < 0.2) break;
  }
  if (!fit.model->isLocallyLinear()) fit = withNewPlant(fit, data, context, kSteps);
  const int components = fit.at.mixture.components();
  if (components < 2) return fit;
  const Fit other = improved(withNewMixture(fit, data, context, components, 8), data,
                             context.options, kSteps, 0.05);
  return other.log_likelihood > fit.log_likelihood + 0.1 ? other : fit;
}

Fit searched(Fit fit, const FitData& data, const FitContext& context) {
  constexpr int kLevels = 4, kHalf = 14;
  if (fit.model->effects().empty()) return fit;
  const std::size_t last = fit.model->effects().size() - 1;
  const auto& parameters = fit.model->effects()[last]->description().parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].smooth) continue;
    const int at = fit.model->offsetOf(last) + static_cast<int>(i);
    double span = 0.06 * (parameters[i].lower == 0 ? parameters[i].upper - parameters[i].lower
                                                   : fit.at.parameters[at]);
    for (int level = 0; level < kLevels; ++level, span *= 0.2) {
      const double centre = fit.at.parameters[at];
      for (int k = -kHalf; k <= kHalf; ++k) {
        ModelParameters moved = fit.at;
        moved.parameters[at] = centre + span * k / kHalf;
        Fit there = evaluated(fit.model, moved, data);
        if (there.log_likelihood > fit.log_likelihood) fit = std::move(there);
      }
      fit = improved(std::move(fit), data, context.options, 3, 0.05);
    }
  }
  return fit;
}

std::vector<FittedEffect> fittedEffects(const Fit& base, const FitData& data,
                                        const Effects& effects, const FitContext& context) {
  constexpr std::size_t kFitted = 12, kConverged = 7;
  constexpr double kHopeless = -6;  // [nats] of predicted score
  const Screening screening(base, data, context.options);
  std::vector<FittedEffect> candidates(effects.size());
  const auto inParallel = [&](std::size_t count, const std::function<void(std::size_t)>& task) {
    context.pool->forEach(static_cast<int>(count), [&](int k) {
      if (context.going_on()) task(static_cast<std::size_t>(k));
    });
  };
  inParallel(effects.size(),
             [&](std::size_t k) { candidates[k] = screened(screening, effects[k], base, data); });
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                  [](const FittedEffect& candidate) {
                                    return candidate.effect == nullptr ||
                                           candidate.score < kHopeless;
                                  }),
                   candidates.end());
  sortByScore(&candidates);
  if (candidates.size() > kFitted) candidates.resize(kFitted);
  inParallel(candidates.size(),
             [&](std::size_t k) { converge(&candidates[k], base, data, context, 4); });
  sortByScore(&candidates);
  inParallel(std::min(kConverged, candidates.size()),
             [&](std::size_t k) { converge(&candidates[k], base, data, context, 15); });
  sortByScore(&candidates);
  return candidates;
}

FittedEffect oneMoreComponent(const Fit& base, const FitData& data,
                              const std::shared_ptr<const Effect>& effect,
                              const FitContext& context) {
  constexpr double kSelection = 1.5;  // [nats] for the choice among many splits
  const int components = base.at.mixture.components(), n = base.at.mixture.dimension();
  FittedEffect candidate{effect, base, 0, kNone};
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
