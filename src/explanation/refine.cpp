#include "explanation/refine.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "estimation/finalists.h"
#include "estimation/initial_guess.h"
#include "model/filter.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The experiments as they would be without the effects: the input is the one that drives the
/// linear model, and the estimated contribution of the effects is subtracted from the output.
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

/// The fit's model linearised about xi = 0; the effects' own points are kept. Posterior means of xi
/// do not carry over to another theta.
std::shared_ptr<const ExtendedModel> aboutZero(const Fit& fit, int experiments) {
  if (!fit.model->isLocallyLinear()) return fit.model;
  return fit.model->about(
      fit.model->points(fit.at.parameters, MatrixXd::Zero(fit.model->regressors(), experiments)));
}

/// Highest log-likelihood at the fit's theta and psi with a mixture of one component.
double withSingleComponent(const Fit& fit, const FitData& data, const FitContext& context) {
  constexpr int kSteps = 20;
  ModelParameters single = fit.at;
  if (single.mixture.components() > 0)
    single.mixture = {{1.0}, {fit.at.mixture.mean()}, {fit.at.mixture.covariance()}};
  return mixtureFitted(fit.model, single, data, context.options, kSteps).log_likelihood;
}

/// The starts of theta, each extended by the fit's psi.
std::vector<VectorXd> withPsi(const Fit& fit, std::vector<VectorXd> starts) {
  const VectorXd psi = fit.at.parameters.tail(fit.model->effectParameterCount());
  for (VectorXd& start : starts) {
    start.conservativeResize(start.size() + psi.size());
    start.tail(psi.size()) = psi;
  }
  return starts;
}

/// The best point with one component from new starts of Go, the noise model and the mixture. Few
/// turns do: what is best is optimised with the effect afterwards.
std::optional<ModelParameters> fromStartsOfAll(const Fit& fit, const Likelihood& likelihood,
                                               const FitData& data, const FitContext& context) {
  constexpr std::size_t kFinalists = 3;
  constexpr int kTurns = 2;
  const auto plain = fit.model->with({});
  const std::vector<VectorXd> starts =
      withPsi(fit, nominalStarts(*plain, NominalModelOptions(), linearPartOf(fit, data)));
  const std::vector<SingleComponent> optima = climbTogether(
      likelihood, rankedSingleComponents(likelihood, starts, kFinalists, context.options),
      context.options, kTurns);
  if (optima.empty()) return {};
  return optima.front().point;
}

/// The same from new starts of Go only, with the fit's noise model. None where all starts have a
/// lower likelihood than the fit with one component.
std::optional<ModelParameters> fromStartsOfPlant(const Fit& fit, const Likelihood& likelihood,
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
  return ranked.front().point;
}

}  // namespace

Fit withNewMixture(const Fit& fit, const FitData& data, const FitContext& context, int components,
                   int restarts) {
  const Likelihood likelihood(*fit.model, data.blocks(), data.count(), 1);
  const Statistics statistics = likelihood.statistics(fit.at.parameters, false);
  ModelParameters single = fit.at;
  single.mixture = {{1.0}, {fit.at.mixture.mean()}, {fit.at.mixture.covariance()}};
  OptimisationOptions options = context.options;
  options.floor = covarianceFloor(single.mixture);
  double reached = 0;
  const ModelParameters at = spreadComponents(likelihood, statistics, single, components, restarts,
                                              context.seed, options, &reached);
  return evaluated(fit.model, at, data);
}

Fit withNewStart(const Fit& fit, const FitData& data, const FitContext& context, int steps) {
  constexpr int kRestarts = 4, kLinearisations = 3;
  constexpr double kHopeless = 100;  // [nats] below the fit: further steps do not catch up
  const auto& effects = fit.model->effects();
  const bool far = std::any_of(effects.begin(), effects.end(),
                               [](const auto& effect) { return effect->has(Trait::moves_plant); });
  try {
    const std::shared_ptr<const ExtendedModel> model = aboutZero(fit, data.count());
    const Likelihood likelihood(*model, data.blocks(), data.count(), 1);
    const std::optional<ModelParameters> single =
        (far ? fromStartsOfAll : fromStartsOfPlant)(fit, likelihood, data, context);
    if (!single) return fit;
    Fit fresh = evaluated(model, *single, data);
    const int components = fit.at.mixture.components();
    if (components > 1 && std::isfinite(fresh.log_likelihood))
      fresh = withNewMixture(fresh, data, context, components, kRestarts);
    for (int round = 0; round < kLinearisations; ++round) fresh = relinearised(fresh, data);
    if (!(fresh.log_likelihood > fit.log_likelihood - kHopeless)) return fit;
    fresh = takeScoringSteps(std::move(fresh), data, context.options, steps, 0.02);
    return fresh.log_likelihood > fit.log_likelihood ? fresh : fit;
  } catch (const Error&) {  // the model has no polynomials, which the starts are made of
    return fit;
  }
}

Fit optimise(Fit fit, const FitData& data, const FitContext& context) {
  constexpr int kRounds = 5, kSteps = 12;
  for (int round = 0; round < kRounds; ++round) {
    Fit next = takeScoringSteps(fit, data, context.options, kSteps, 0.01);
    const double gain = next.log_likelihood - fit.log_likelihood;
    if (gain > 0) fit = std::move(next);
    if (gain < 0.2) break;
  }
  return fit;
}

Fit optimiseWithRestarts(Fit fit, const FitData& data, const FitContext& context,
                         bool restart_theta) {
  constexpr int kSteps = 12;
  fit = optimise(std::move(fit), data, context);
  if (restart_theta) fit = withNewStart(fit, data, context, kSteps);
  const int components = fit.at.mixture.components();
  if (components < 2) return fit;
  const Fit other = takeScoringSteps(withNewMixture(fit, data, context, components, 8), data,
                                     context.options, kSteps, 0.05);
  return other.log_likelihood > fit.log_likelihood + 0.1 ? other : fit;
}

Fit searchGrid(Fit fit, const FitData& data, const FitContext& context) {
  constexpr int kLevels = 4, kHalf = 14;  // grids of 2 kHalf + 1 points, each finer than the last
  if (fit.model->effects().empty()) return fit;
  const std::size_t last = fit.model->effects().size() - 1;
  const auto& parameters = fit.model->effects()[last]->description().parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].smooth) continue;
    const int at = fit.model->offsetOf(last) + static_cast<int>(i);
    double span = 0.06 * (parameters[i].lower == 0 ? parameters[i].upper - parameters[i].lower
                          : std::isfinite(parameters[i].lower) ? fit.at.parameters[at]
                                                               : parameters[i].scale);
    for (int level = 0; level < kLevels; ++level, span *= 0.2) {
      const double centre = fit.at.parameters[at];
      for (int k = -kHalf; k <= kHalf; ++k) {
        ModelParameters moved = fit.at;
        moved.parameters[at] = centre + span * k / kHalf;
        Fit there = evaluated(fit.model, moved, data);
        if (there.log_likelihood > fit.log_likelihood) fit = std::move(there);
      }
      fit = takeScoringSteps(std::move(fit), data, context.options, 3, 0.05);
    }
  }
  return fit;
}

}  // namespace uncertainty_identification
