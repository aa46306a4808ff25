#include "identification/structure_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "configuration/thread_count.h"
#include "estimation/first_samples.h"
#include "estimation/initial_guess.h"
#include "estimation/linearisation.h"
#include "estimation/scoring.h"
#include "estimation/selection.h"
#include "identification/steps.h"
#include "math/information_criterion.h"
#include "model/evaluation.h"
#include "model/modal.h"
#include "model/sensitivity.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A point of a model, with the linearisation about its posterior means where need be.
struct LinearisedPoint {
  std::shared_ptr<const LinearModel> model;
  ModelParameters point;
  double log_likelihood = 0;
  Eigen::MatrixXd points{};  ///< of the linearisation, a column for each experiment
};

/// Scoring steps from a point, alternating with linearisations where the model is only locally
/// linear.
LinearisedPoint improved(std::shared_ptr<const LinearModel> model, ModelParameters point,
                         const CheckedData& data, int steps, const OptimisationOptions& wanted,
                         int threads, int* passes, const Eigen::MatrixXd& from = {}) {
  constexpr int kRounds = 3;
  OptimisationOptions options = wanted;
  LinearisedPoint now{std::move(model), std::move(point), 0, from};
  const bool goes_on = from.size() > 0;  // and does not begin at zero each time
  const auto linearise = [&] {
    auto about =
        linearisedAtPosteriorMeans(*now.model, data.blocks, data.count(), threads, now.point,
                                   passes, goes_on ? now.points : Eigen::MatrixXd());
    if (!about) return;
    now.model = std::move(about->model);
    now.points = std::move(about->points);
  };
  const int rounds = now.model->isLocallyLinear() ? kRounds : 1;
  LinearisedPoint best;
  best.log_likelihood = -std::numeric_limits<double>::infinity();
  for (int round = 0; round <= rounds; ++round) {
    linearise();  // the last steps moved the plants
    const Likelihood likelihood(*now.model, data.blocks, data.count(), threads);
    if (goes_on || round == rounds) {
      now.log_likelihood = logLikelihoodAtPoints(*now.model, likelihood, now.point, now.points);
      const bool is_best = now.log_likelihood > best.log_likelihood;
      if (is_best || !goes_on) best = now;
      if (!is_best || round == rounds) break;  // about other plants, the steps led away
    }
    options.floor = covarianceFloor(now.point.mixture);
    now.point = scoringSteps(likelihood, now.point, options, steps, 1e-2);
    *passes += likelihood.passes();
  }
  return best;
}

/// Log density of experiments at a point of a model, all but their first samples.
double logDensity(const LinearModel& model, const ModelParameters& point, const CheckedData& data,
                  const EstimationOptions& options, int threads, int* passes) {
  const auto about =
      linearisedAtPosteriorMeans(model, data.blocks, data.count(), threads, point, passes);
  const LinearModel& linear = about ? *about->model : model;
  const Likelihood likelihood(linear, data.blocks, data.count(), threads);
  const double total =
      logLikelihoodAtPoints(linear, likelihood, point, about ? about->points : Eigen::MatrixXd());
  *passes += likelihood.passes();
  if (!hasUnknownsOfExperiments(options)) return total;
  return total - firstSamplesDensity(linear, point, data.experiments, threads, passes);
}

CheckedData subset(const CheckedData& data, int fold, int folds, bool inside) {
  CheckedData part;
  for (int r = 0; r < data.count(); ++r)
    if ((r % folds == fold) == inside)
      part.experiments.push_back(data.experiments[static_cast<std::size_t>(r)]);
  part.blocks = makeBlocks(part.experiments);
  return part;
}

/// The parameters of a model at a starting point.
VectorXd parametersAt(const LinearModel& model, const StartingPoint& start) {
  VectorXd parameters = VectorXd::Zero(model.parameterCount());
  const VectorXd theta = model.nominal().fromPolynomials(start.polynomials);
  parameters.head(theta.size()) = theta;
  const std::vector<ParameterRole> roles = model.roles();
  const auto next = static_cast<std::size_t>(theta.size());
  if (next >= roles.size()) return parameters;
  const Polynomials& p = start.polynomials;
  const double gain = p.b.sum() / (1 + p.a.sum());
  if (roles[next].of == ParameterRole::Of::output_offset) parameters[theta.size()] = start.offset;
  if (roles[next].of == ParameterRole::Of::input_offset && std::abs(gain) > 1e-9)
    parameters[theta.size()] = start.offset / gain;
  return parameters;
}

std::vector<VectorXd> startsOf(const Problem& problem, const LinearModel& model,
                               const std::vector<StartingPoint>& points, bool from_data) {
  if (hasGivenParameters(problem)) return {givenParameters(problem, model)};
  std::vector<VectorXd> starts =
      from_data ? startsFromData(problem, model) : std::vector<VectorXd>();
  for (const StartingPoint& point : points) {
    const VectorXd start = parametersAt(model, point);
    if (model.admissible(start)) starts.insert(starts.begin(), start);
  }
  return starts;
}

LinearisedPoint nothing() { return {nullptr, {}, -std::numeric_limits<double>::infinity()}; }

/// The fit of a problem's own configuration at a point; none where the likelihood is not finite.
std::optional<StructureFit> fitAt(const Problem& problem, const std::string& description,
                                  LinearisedPoint at, Journal* journal) {
  const Configuration& configuration = problem.configuration;
  if (at.model != nullptr && hasUnknownsOfExperiments(configuration.estimation))
    at.log_likelihood -=
        firstSamplesDensity(*at.model, at.point, problem.data.experiments,
                            threadCount(configuration.estimation.threads), &journal->passes);
  if (!std::isfinite(at.log_likelihood)) return {};
  const int fixed = problem.plant ? static_cast<int>(problem.plant->point.parameters.size()) : 0;
  return StructureFit{{description, configuration},
                      at.model,
                      at.point,
                      at.log_likelihood,
                      at.model->parameterCount() + 1 + fixed,
                      mixtureParameters(configuration, at.model->regressors(), 1),
                      at.points};
}

/// The optimum near some starts, about the first of which a model that is only locally linear is
/// linearised together with what the data say of each experiment's start.
LinearisedPoint fitFrom(const Problem& problem, std::shared_ptr<const LinearModel> model,
                        const std::vector<VectorXd>& starts, const OptimisationOptions& options,
                        Journal* journal) {
  constexpr std::size_t kFinalists = 2;
  constexpr int kSteps = 20;
  const CheckedData& data = problem.data;
  if (auto at_start = linearisedAtStart(*model, data.blocks, data.count(), starts.front()))
    model = std::move(at_start);
  const std::unique_ptr<Likelihood> likelihood = likelihoodOf(problem, *model);
  const std::vector<SingleComponent> ranked =
      rankedSingleComponents(*likelihood, starts, kFinalists, options);
  journal->passes += likelihood->passes();
  if (ranked.empty() || !model->admissible(ranked.front().point.parameters)) return nothing();
  return improved(model, ranked.front().point, data, kSteps, options,
                  threadCount(problem.configuration.estimation.threads), &journal->passes);
}

}  // namespace

int mixtureParameters(const Configuration& configuration, int dimension, int components) {
  const int free = mixtureParameters(configuration.error_model.constraint, dimension, components);
  if (!variesAlongDirections(configuration)) return free;
  const auto all = static_cast<int>(configuration.nominal_model.center.size());
  return free + dimension * (all - dimension);
}

double scoreOf(const Problem& problem, const StructureFit& fit) {
  return fit.log_likelihood -
         bicPenalty(fit.parameters, static_cast<double>(problem.data.validSamples())) -
         bicPenalty(fit.mixture, problem.data.count());
}

double scoreAfterFirstSamples(const Problem& problem, const StructureFit& fit, Journal* journal) {
  const double score = scoreOf(problem, fit);
  const EstimationOptions& options = fit.structure.configuration.estimation;
  if (hasUnknownsOfExperiments(options)) return score;
  return score - firstSamplesDensity(*fit.model, fit.point, problem.data.experiments,
                                     threadCount(options.threads), &journal->passes);
}

StartingPoint StructureFit::start() const {
  const NominalModel& nominal = model->nominal();
  return {nominal.polynomials(point.parameters.head(nominal.parameterCount())),
          plantOf(*model, point).offset};
}

std::optional<StructureFit> fitStructure(const Problem& problem, const ErrorStructure& structure,
                                         const std::vector<StartingPoint>& points, bool from_data,
                                         Journal* journal) {
  constexpr std::size_t kMostStarts = 2;
  Problem own = problem;
  own.configuration = structure.configuration;
  completeErrorModel(*remainingNominalModel(own), &own.configuration.error_model);
  const Configuration& configuration = own.configuration;
  const std::shared_ptr<const LinearModel> model = buildModel(own);
  const OptimisationOptions options =
      optimisationOptions(configuration, Phase::structure, &journal->progress);
  std::vector<VectorXd> starts = startsOf(own, *model, points, from_data);
  if (starts.empty()) return {};
  LinearisedPoint best = nothing();
  if (!model->isLocallyLinear() || !estimatesInitialState(configuration.estimation)) {
    best = fitFrom(own, model, starts, options, journal);
  } else {
    starts.resize(std::min(starts.size(), kMostStarts));
    for (const VectorXd& start : starts) {
      LinearisedPoint reached = fitFrom(own, model, {start}, options, journal);
      if (reached.log_likelihood > best.log_likelihood) best = std::move(reached);
    }
  }
  return fitAt(own, structure.description, std::move(best), journal);
}

std::optional<StructureFit> fitStructureFrom(const Problem& problem,
                                             const ErrorStructure& structure,
                                             const ModelParameters& start,
                                             const Eigen::MatrixXd& xi, Journal* journal) {
  constexpr int kSteps = 20;
  Problem own = problem;
  own.configuration = structure.configuration;
  const std::shared_ptr<const LinearModel> model = buildModel(own);
  if (start.parameters.size() != model->parameterCount()) return {};  // as with effects
  if (!model->admissible(start.parameters)) return {};
  const OptimisationOptions options =
      optimisationOptions(own.configuration, Phase::structure, &journal->progress);
  return fitAt(own, structure.description,
               improved(model, start, own.data, kSteps, options,
                        threadCount(own.configuration.estimation.threads), &journal->passes,
                        pointsAt(*model, own.data.blocks, start.parameters, xi)),
               journal);
}

double heldOutDensity(const Problem& problem, const StructureFit& fit, Journal* journal) {
  constexpr int kFolds = 5, kSteps = 6;
  const int folds = std::min(kFolds, problem.data.count());
  const int threads = threadCount(problem.configuration.estimation.threads);
  const OptimisationOptions options =
      optimisationOptions(fit.structure.configuration, Phase::structure, &journal->progress);
  Problem own = problem;
  own.configuration = fit.structure.configuration;
  const std::shared_ptr<const LinearModel> model = buildModel(own);  // linearised about zero
  double sum = 0;
  for (int fold = 0; fold < folds; ++fold) {
    const CheckedData others = subset(problem.data, fold, folds, false);
    const CheckedData held_out = subset(problem.data, fold, folds, true);
    const LinearisedPoint trained =
        improved(model, fit.point, others, kSteps, options, threads, &journal->passes);
    sum += logDensity(*model, trained.point, held_out, own.configuration.estimation, threads,
                      &journal->passes);
  }
  return std::isfinite(sum) ? sum / problem.data.count() : -std::numeric_limits<double>::infinity();
}

}  // namespace uncertainty_identification
