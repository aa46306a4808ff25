#include <algorithm>

#include "configuration/thread_count.h"
#include "estimation/excerpt.h"
#include "estimation/initial_guess.h"
#include "estimation/linearisation.h"
#include "estimation/selection.h"
#include "identification/steps.h"
#include "identification/structure_fit.h"
#include "math/information_criterion.h"
#include "uncertainty_identification/errors.h"

/// Where the optimisation starts, and with how many components.
namespace uncertainty_identification {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

const ParameterEstimate* named(const std::vector<ParameterEstimate>& parameters,
                               const std::string& name) {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const ParameterEstimate& one) { return one.name == name; });
  return found == parameters.end() ? nullptr : &*found;
}

/// The value of a model's parameter k in an earlier estimate; 0 if the estimate does not have it.
double previousValue(const Estimate& previous, const LinearModel& model, std::size_t k,
                     const ParameterRole& role) {
  if (role.of == ParameterRole::Of::input_offset) return previous.offset_u;
  if (role.of == ParameterRole::Of::output_offset) return previous.offset_y;
  if (role.of == ParameterRole::Of::nominal_model) {
    const ParameterEstimate* found = named(previous.nominal_model.parameters, role.name);
    return found == nullptr ? 0.0 : found->value;
  }
  for (const EffectEstimate& effect : previous.effects) {
    if (effect.name != role.effect_name || effect.variant != role.effect_variant) continue;
    if (const ParameterEstimate* found = named(effect.parameters, role.name))
      return model.fromReported(k, found->value, previous.noise_variance.value);
  }
  return 0.0;
}

VectorXd previousParameters(const Estimate& previous, const LinearModel& model) {
  const std::vector<ParameterRole> roles = model.roles();
  VectorXd parameters(static_cast<Index>(roles.size()));
  for (std::size_t k = 0; k < roles.size(); ++k)
    parameters[static_cast<Index>(k)] = previousValue(previous, model, k, roles[k]);
  return parameters;
}

/// `initial.theta`, an offset of zero and the effects' starting values.
VectorXd initialParameters(const Problem& problem, const LinearModel& model) {
  const std::vector<std::string> names = nominalModelOf(problem)->names();
  const VectorXd& theta = problem.configuration.initial.theta;
  if (theta.size() != static_cast<Index>(names.size())) {
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
    throw ConfigurationError("initial.theta: the model has " + std::to_string(names.size()) +
                             " parameters (" + all + "), found " + std::to_string(theta.size()));
  }
  VectorXd own = VectorXd::Zero(model.parameterCount());
  Index count = 0;
  for (const ParameterRole& role : model.roles()) {
    if (role.of == ParameterRole::Of::effect) continue;
    const auto found = std::find(names.begin(), names.end(), role.name);
    if (found != names.end()) own[count] = theta[found - names.begin()];
    ++count;
  }
  return model.withStartingValues(own.head(count), problem.configuration.effects);
}

/// A start with the given mixture and the noise variance of the previous estimate or `initial`; if
/// neither gives one, it is computed by one EM update.
ModelParameters withGivenMixture(const Problem& problem, const Mixture& mixture,
                                 const VectorXd& parameters, const Likelihood& likelihood) {
  const int dimension = likelihood.model().regressors();
  if (mixture.dimension() != dimension) {
    throw ConfigurationError("initial.means: the error model has " + std::to_string(dimension) +
                             " free parameters, found " + std::to_string(mixture.dimension()));
  }
  ModelParameters start{parameters, mixture, 1.0};
  const std::optional<double>& given = problem.configuration.initial.noise_variance;
  if (problem.previous != nullptr) {
    start.noise_variance = problem.previous->noise_variance.value;
  } else if (given) {
    start.noise_variance = *given;
  } else {
    const Statistics statistics = likelihood.statistics(parameters, false);
    updateMixture(statistics, likelihood.expect(statistics, start), OptimisationOptions(), &start);
    start.mixture = mixture;
  }
  return start;
}

/// The largest number of components that the automatic choice tries: each needs two experiments for
/// each of its parameters, because a component shrinks onto few experiments at no cost.
int mostComponents(const Problem& problem, int regressors) {
  const int parameters = 1 + regressors + regressors * (regressors + 1) / 2;
  return std::min(problem.configuration.error_model.max_components,
                  problem.data.count() / (2 * parameters));
}

/// A start with the mixture: with the configured number of components, or with the number of lowest
/// BIC if it is automatic.
ModelParameters chooseComponents(const Problem& problem, const ModelParameters& single,
                                 const Likelihood& likelihood, Journal* journal) {
  const ErrorModelOptions& error_model = problem.configuration.error_model;
  const EstimationOptions& estimation = problem.configuration.estimation;
  OptimisationOptions options =
      optimisationOptions(problem.configuration, Phase::components, &journal->progress);
  options.floor = covarianceFloor(single.mixture);
  const bool automatic = error_model.components == kAutomatic;
  const int first = automatic ? 1 : error_model.components;
  const int last = automatic ? mostComponents(problem, likelihood.model().regressors()) : first;
  const Statistics statistics = likelihood.statistics(single.parameters, false);
  const int parameters = likelihood.model().parameterCount() + 1;
  std::vector<ModelParameters> points;
  std::vector<Candidate> candidates;
  for (int components = first; components <= std::max(last, first); ++components) {
    double reached = 0;
    points.push_back(spreadComponents(likelihood, statistics, single, components,
                                      estimation.restarts, estimation.seed, options, &reached));
    const int mixture =
        mixtureParameters(problem.configuration, likelihood.model().regressors(), components);
    candidates.push_back(
        {"components",
         "components=" + std::to_string(components),
         parameters + mixture,
         reached + smallComponentPenalty(points.back().mixture, problem.data.count()),
         bic(reached, parameters, mixture, statistics.samples().sum(), problem.data.count()),
         {},
         false});
  }
  const std::optional<std::size_t> least = chooseLeastBic(0, &candidates);
  if (automatic)
    journal->candidates.insert(journal->candidates.end(), candidates.begin(), candidates.end());
  return least ? points[*least] : single;
}

/// The best of the optima with a single component once they have as many components as `first`,
/// which comes from the highest of them.
ModelParameters bestMixture(const Problem& problem, const ModelParameters& first,
                            const std::vector<SingleComponent>& optima,
                            const Likelihood& likelihood, OptimisationOptions options) {
  constexpr int kTurns = 4;
  const EstimationOptions& estimation = problem.configuration.estimation;
  std::vector<Finalist> finalists;
  for (const SingleComponent& single : optima) {
    const Statistics statistics = likelihood.statistics(single.point.parameters, false);
    Finalist one;
    if (finalists.empty()) {
      one = {first, likelihood.expect(statistics, first).total()};
    } else {
      options.floor = covarianceFloor(single.point.mixture);
      one.point =
          spreadComponents(likelihood, statistics, single.point, first.mixture.components(),
                           estimation.restarts, estimation.seed, options, &one.log_likelihood);
    }
    finalists.push_back(std::move(one));
  }
  const std::vector<Finalist> reached = climbTogether(likelihood, finalists, options, kTurns);
  return reached.empty() ? first : reached.front().point;
}

}  // namespace

bool hasGivenParameters(const Problem& problem) {
  return problem.previous != nullptr || problem.configuration.initial.theta.size() > 0;
}

const Mixture& givenMixture(const Problem& problem) {
  static const Mixture kNone;
  if (problem.configuration.error_model.taps == 0) return kNone;
  return problem.previous != nullptr ? problem.previous->error_model.mixture
                                     : problem.configuration.initial.mixture;
}

VectorXd givenParameters(const Problem& problem, const LinearModel& model) {
  const VectorXd parameters = problem.previous != nullptr
                                  ? previousParameters(*problem.previous, model)
                                  : initialParameters(problem, model);
  if (!model.admissible(parameters)) {
    throw ConfigurationError(
        "initial.theta: the roots of A, C and D must lie inside the unit circle");
  }
  return parameters;
}

namespace {

/// The starts, each also with the plant in the middle of the stated directions.
void addCenter(const NominalModelOptions& options, std::vector<VectorXd>* starts) {
  if (options.structure != Structure::modal || options.directions.size() == 0) return;
  const std::vector<VectorXd> without = *starts;
  for (VectorXd start : without) {
    start.head(options.center.size()).setOnes();
    starts->insert(starts->begin(), start);
  }
}

}  // namespace

std::vector<VectorXd> startsFromData(const Problem& problem, const LinearModel& model) {
  const Configuration& configuration = problem.configuration;
  const std::vector<Experiment> experiments =
      fewerSamples(problem.data.experiments, 2 * kEnoughSamples);
  const LinearModel plain(remainingNominalModel(problem), model.basis(), configuration.estimation);
  std::vector<VectorXd> starts =
      problem.plant
          ? noiseStarts(plain, problem.plant->polynomials, problem.plant->offset, experiments)
          : nominalStarts(plain, configuration.nominal_model, experiments);
  for (VectorXd& start : starts) start = model.withStartingValues(start, configuration.effects);
  addCenter(configuration.nominal_model, &starts);
  if (problem.start.size() == model.parameterCount()) starts.insert(starts.begin(), problem.start);
  return starts;
}

Eigen::MatrixXd pointsToStartFrom(const Problem& problem, const LinearModel& model) {
  const bool fits = problem.reached && !hasGivenParameters(problem) &&
                    problem.configuration.nominal_model.structure == Structure::modal &&
                    problem.points.cols() == problem.data.count() &&
                    problem.reached->parameters.size() == model.parameterCount();
  return fits ? problem.points : Eigen::MatrixXd();
}

std::optional<Linearisation> linearisedToStart(const Problem& problem, const LinearModel& model,
                                               const ModelParameters& start, Journal* journal) {
  const Eigen::MatrixXd points = pointsToStartFrom(problem, model);
  auto at_means = linearisedAtPosteriorMeans(model, problem.data.blocks, problem.data.count(),
                                             threadCount(problem.configuration.estimation.threads),
                                             start, &journal->passes, points);
  if (points.size() == 0) return at_means;
  Linearisation known{model.linearisedAbout(points), points, 0};
  const auto at = [&](const Linearisation& about) {
    return logLikelihoodAtPoints(*about.model, *likelihoodOf(problem, *about.model), start,
                                 about.points);
  };
  if (at(*at_means) > at(known)) return at_means;  // which may lead away, and to nothing finite
  return known;
}

ModelParameters requireStart(const std::optional<ModelParameters>& found,
                             const LinearModel& model) {
  if (found && model.admissible(found->parameters)) return *found;
  throw DataError(
      "the likelihood is not finite at any start; check the units and the scale of the data, or "
      "give a start: initial.theta");
}

/// The optimum with one component. A model that is only locally linear is not climbed about zero,
/// where it would leave the plants that differ much, but starts where its structure was chosen.
std::vector<SingleComponent> singleOptima(const Problem& problem, const LinearModel& model,
                                          const Likelihood& likelihood,
                                          const std::vector<VectorXd>& starts, Journal* journal) {
  const std::optional<ModelParameters>& reached = problem.reached;
  if (model.isLocallyLinear() && reached && !hasGivenParameters(problem) &&
      reached->parameters.size() == model.parameterCount() &&
      reached->mixture.dimension() == model.regressors() && model.admissible(reached->parameters))
    return {{*reached, 0}};
  return singleComponentOptima(
      likelihood, starts,
      optimisationOptions(problem.configuration, Phase::start, &journal->progress));
}

ModelParameters findStart(const Problem& problem, const LinearModel& model,
                          const Likelihood& likelihood, Journal* journal) {
  const std::vector<VectorXd> starts = hasGivenParameters(problem)
                                           ? std::vector<VectorXd>{givenParameters(problem, model)}
                                           : startsFromData(problem, model);
  if (starts.empty())
    throw DataError("no start could be found for these orders; give `initial: {theta: [...]}`");
  const Mixture& mixture = givenMixture(problem);
  if (mixture.components() > 0)
    return withGivenMixture(problem, mixture, starts.front(), likelihood);
  const OptimisationOptions options =
      optimisationOptions(problem.configuration, Phase::start, &journal->progress);
  const std::vector<SingleComponent> optima =
      singleOptima(problem, model, likelihood, starts, journal);
  const ModelParameters single =
      requireStart(optima.empty() ? std::nullopt : std::optional(optima.front().point), model);
  if (problem.configuration.error_model.components == 1) return single;
  // How experiments are distributed shows where each is linearised about its own plant.
  const auto about = linearisedToStart(problem, model, single, journal);
  const std::unique_ptr<Likelihood> near = about ? likelihoodOf(problem, *about->model) : nullptr;
  const ModelParameters start =
      chooseComponents(problem, single, near ? *near : likelihood, journal);
  if (near) journal->passes += near->passes();
  if (near || optima.size() == 1 || start.mixture.components() < 2) return start;
  return bestMixture(problem, start, optima, likelihood, options);
}

}  // namespace uncertainty_identification
