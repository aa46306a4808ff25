#include "candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "screening.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/estimation/initial_guess.h"
#include "uncertainty_identification/model/filter.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNone = -std::numeric_limits<double>::infinity();

double penaltyOf(const Effect& effect, const FitData& data) {
  const double parameters = effect.parameterCount();
  const double each = isOfMixture(effect) ? std::log(data.count()) : std::log(data.samples());
  const double starts =
      static_cast<double>(std::max<std::size_t>(1, effect.description().starts.size()));
  return 0.5 * parameters * each + std::log(starts);
}

/// The experiments as the linear part of the model alone would have met them: the input that drives
/// it, and the measurement less what the effects are estimated to have done to it.
std::vector<Experiment> linearPartOf(const Fit& fit, const FitData& data) {
  std::vector<Experiment> experiments = data.experiments();
  const VectorXd plain_parameters =
      fit.at.parameters.head(fit.at.parameters.size() - fit.model->effectParameterCount());
  const auto plain = fit.model->with({});
  for (const Block& block : data.blocks()) {
    Block driven = block;
    driven.u = fit.model->drivingInput(block, fit.at.parameters);
    const Signals effects = fit.model->simulated(block, fit.at.parameters, fit.xi).expected() -
                            plain->simulated(driven, plain_parameters, fit.xi).expected();
    for (int lane = 0; lane < block.lanes; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      const int length = block.lengths[at];
      Experiment& experiment = experiments[static_cast<std::size_t>(block.index[at])];
      experiment.u = driven.u.row(lane).head(length).transpose();
      experiment.y -= effects.row(lane).head(length).transpose().matrix();
    }
  }
  return experiments;
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

/// The fit's model about zero error parameters, the effects' own points kept: xi of one theta is
/// none of another's.
std::shared_ptr<const ExtendedModel> aboutZero(const Fit& fit, int experiments) {
  if (!fit.model->isLocallyLinear()) return fit.model;
  return fit.model->about(
      fit.model->points(fit.at.parameters, MatrixXd::Zero(fit.model->regressors(), experiments)));
}

/// Highest likelihood at the fit's theta and psi with a single component.
double withSingleComponent(const Fit& fit, const FitData& data, const FitContext& context) {
  constexpr int kSteps = 20;
  ModelParameters single = fit.at;
  if (single.mixture.components() > 0)
    single.mixture = {{1.0}, {fit.at.mixture.mean()}, {fit.at.mixture.covariance()}};
  return mixtureFitted(fit.model, single, data, context.options, kSteps).log_likelihood;
}

/// Starts of theta with the fit's psi.
std::vector<VectorXd> withPsi(const Fit& fit, std::vector<VectorXd> starts) {
  const VectorXd psi = fit.at.parameters.tail(fit.model->effectParameterCount());
  for (VectorXd& start : starts) {
    start.conservativeResize(start.size() + psi.size());
    start.tail(psi.size()) = psi;
  }
  return starts;
}

/// Whether theta may lie far from where it was without the effect.
bool movesPlant(const Effect& effect) {
  return effect.name() == "act_delay" || effect.name() == "plant_pole" ||
         effect.name() == "sens_lag";
}

/// Where new starts of Go, noise model and mixture lead with a single component, given psi.
std::optional<ModelParameters> singleFromAnywhere(const Fit& fit, const Likelihood& likelihood,
                                                  const FitData& data, const FitContext& context) {
  const auto plain = fit.model->with({});
  return bestSingleComponent(
      likelihood,
      withPsi(fit, nominalStarts(*plain, NominalModelOptions(), linearPartOf(fit, data))),
      context.options);
}

/// The same around the fit's noise model; none where the starts lead no higher than where the fit
/// is.
std::optional<ModelParameters> singleFromNear(const Fit& fit, const Likelihood& likelihood,
                                              const FitData& data, const FitContext& context) {
  constexpr std::size_t kFinalists = 2;
  const NominalModel& nominal = fit.model->nominal();
  const Polynomials noise = nominal.polynomials(fit.at.parameters.head(nominal.parameterCount()));
  const std::vector<VectorXd> starts =
      withPsi(fit, plantStarts(*fit.model->with({}), noise, linearPartOf(fit, data)));
  const std::vector<SingleComponent> ranked =
      rankedSingleComponents(likelihood, starts, kFinalists, context.options);
  if (ranked.empty() || ranked.front().log_likelihood < withSingleComponent(fit, data, context))
    return {};
  return ranked.front().at;
}

/// Theta and mixture started anew, given psi; kept if that leads higher.
Fit withNewStart(const Fit& fit, const FitData& data, const FitContext& context, int steps) {
  constexpr int kRestarts = 4;
  constexpr double kHopeless = 100;  // [nats]
  const auto& effects = fit.model->effects();
  const bool far = std::any_of(effects.begin(), effects.end(),
                               [](const auto& effect) { return movesPlant(*effect); });
  try {
    const std::shared_ptr<const ExtendedModel> model = aboutZero(fit, data.count());
    const Likelihood likelihood(*model, data.blocks(), data.count(), 1);
    const std::optional<ModelParameters> single =
        (far ? singleFromAnywhere : singleFromNear)(fit, likelihood, data, context);
    if (!single) return fit;
    Fit fresh = evaluated(model, *single, data);
    const int components = fit.at.mixture.components();
    if (components > 1 && std::isfinite(fresh.log_likelihood))
      fresh = withNewMixture(fresh, data, context, components, kRestarts);
    for (int round = 0; round < 3; ++round) fresh = relinearised(fresh, data);
    if (!(fresh.log_likelihood > fit.log_likelihood - kHopeless)) return fit;
    fresh = improved(std::move(fresh), data, context.options, steps, 0.02);
    return fresh.log_likelihood > fit.log_likelihood ? fresh : fit;
  } catch (const Error&) {  // a model without polynomials to start from
    return fit;
  }
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
  const auto& parameters = candidate.effect->description().parameters;
  for (const double share : {1.0, 0.4}) {
    if (candidate.step.size() == 0) break;
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

Fit settled(Fit fit, const FitData& data, const FitContext& context) {
  constexpr int kRounds = 5, kSteps = 12;
  for (int round = 0; round < kRounds; ++round) {
    Fit next = improved(fit, data, context.options, kSteps, 0.01);
    const double gain = next.log_likelihood - fit.log_likelihood;
    if (gain > 0) fit = std::move(next);
    if (gain < 0.2) break;
  }
  return fit;
}

Fit polished(Fit fit, const FitData& data, const FitContext& context, bool anew) {
  constexpr int kSteps = 12;
  fit = settled(std::move(fit), data, context);
  if (anew) fit = withNewStart(fit, data, context, kSteps);
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
  std::size_t fitted = 0;
  candidates.erase(
      std::remove_if(candidates.begin(), candidates.end(),
                     [&](const FittedEffect& candidate) {
                       if (candidate.effect == nullptr) return true;
                       if (wrong && movesPlant(*candidate.effect)) return false;
                       return (candidate.score < hopeless && !isOfMixture(*candidate.effect)) ||
                              ++fitted > kFitted;
                     }),
      candidates.end());
  inParallel(candidates.size(), [&](std::size_t k) {
    converge(&candidates[k], approached(candidates[k], data, context), base, data, context, 4,
             movesPlant(*candidates[k].effect));
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
