#include <algorithm>
#include <cmath>
#include <utility>

#include "estimation/linearisation.h"
#include "identification/steps.h"
#include "math/symmetric_eigen.h"
#include "uncertainty_identification/errors.h"

/// The optimisation of the likelihood. Models that are linear in the error parameters only near a
/// point for each experiment are linearised about the posterior means, by a fixed-point iteration
/// (docs/method.md, section on parameters that vary).
namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;

/// Replaces the model and the likelihood, which refers to it.
void useModel(const Problem& problem, std::unique_ptr<LinearModel> model, FittedModel* fitted,
              Journal* journal) {
  if (fitted->likelihood != nullptr) journal->passes += fitted->likelihood->passes();
  fitted->likelihood = likelihoodOf(problem, *model);
  fitted->model = std::move(model);
}

void requireEnoughSamples(const Problem& problem, const LinearModel& model) {
  const int parameters = model.parameterCount() + 1;
  Response response;
  const Eigen::VectorXd anywhere =
      model.fromUnbounded(Eigen::VectorXd::Zero(model.parameterCount()));
  model.evaluate(problem.data.blocks.back(), anywhere, false, &response);
  const long nuisances = static_cast<long>(response.column_precision.size()) * problem.data.count();
  const long samples = problem.data.validSamples();
  if (samples >= 2 * (parameters + nuisances)) return;
  throw DataError(
      "the orders are too large for the data: " + std::to_string(parameters) + " parameters and " +
      std::to_string(nuisances) + " unknown initial values or offsets against " +
      std::to_string(samples) +
      " measured samples; lower the orders (nominal_model: nb, na, nc, nd, delay), set "
      "estimation.initial_state: zero if the experiments start at rest, or record longer "
      "experiments");
}

/// Optimises from the point reached so far, with the iterations that are left.
void optimise(const Problem& problem, OptimisationOptions options, int passes,
              FittedModel* fitted) {
  const Optimum& before = fitted->optimum;
  options.max_iterations -= before.iterations;
  const bool em = problem.configuration.estimation.algorithm == Algorithm::em;
  Optimum next = (em ? expectationMaximisation : maximumLikelihood)(*fitted->likelihood,
                                                                    before.point, options);
  next.point.mixture.sortComponents();
  for (TracePoint& done : next.trace) {
    done.iteration += before.iterations;
    done.passes += passes;
  }
  next.iterations += before.iterations;
  next.trace.insert(next.trace.begin(), before.trace.begin(), before.trace.end());
  fitted->optimum = std::move(next);
}

/// A few steps only: while the points of linearisation move, so does the optimum.
OptimisationOptions fewSteps(const Problem& problem, OptimisationOptions options,
                             const Optimum& before) {
  constexpr int kFew = 5;
  if (problem.configuration.estimation.algorithm != Algorithm::em)
    options.max_iterations = std::min(options.max_iterations, before.iterations + kFew);
  return options;
}

void didNotConverge(Optimum* optimum) {
  optimum->termination = Termination::stalled;
  optimum->message =
      "the points about which the model is linearised did not converge; the experiments may be too "
      "short to determine their own parameters";
}

/// Alternates between optimising and linearising about the new posterior means until these, or the
/// likelihood, no longer move: about a kink, as a dead time has at each sample, points may move to
/// and fro. The estimate then maximises the likelihood linearised about its own posterior means.
/// Points that do not converge have no such maximum: after many rounds, it goes on only as long as
/// they move less and less.
void optimiseToFixedPoint(const Problem& problem, const OptimisationOptions& options,
                          MatrixXd points, FittedModel* fitted, Journal* journal) {
  constexpr int kManyRounds = 50, kManyFromKnown = 10, kStill = 3;
  constexpr double kImmaterial = 0.01;  // [nats]
  constexpr double kFirst = 0.1;        // of the tolerance
  const bool known = pointsToStartFrom(problem, *fitted->model).size() > 0;
  const int many = known ? kManyFromKnown : kManyRounds;
  bool complete = !known;  // with all steps
  optimise(problem, complete ? options : fewSteps(problem, options, fitted->optimum),
           journal->passes, fitted);
  bool ends = false;
  FixedPointProgress progress;
  StepShare share;
  for (int round = 0, still = 0; fitted->model->isLocallyLinear(); ++round) {
    const double before = fitted->optimum.log_likelihood;
    Optimum& optimum = fitted->optimum;
    if (journal->progress.searchEnds() || optimum.iterations >= options.max_iterations) return;
    Linearisation next =
        nextLinearisation(*fitted->model, *fitted->likelihood, optimum.point, points, &share);
    // The first optimisation may end near its points by chance: once more, unless it hardly moved.
    const double tolerance = (round == 0 ? kFirst : 1) * kFixedPointTolerance;
    const bool arrived = next.move < tolerance || still >= kStill;
    if (arrived && complete) return;
    if (ends && !arrived) return didNotConverge(&optimum);
    ends = !progress.approaches(before, next.move) || (round >= many && !progress.slowsDown());
    complete = arrived;
    const Optimum reached = optimum;
    const MatrixXd about = std::exchange(points, std::move(next.points));
    useModel(problem, std::move(next.model), fitted, journal);
    optimise(problem, complete ? options : fewSteps(problem, options, optimum), journal->passes,
             fitted);
    if (!std::isfinite(optimum.log_likelihood) || optimum.is_lost) {
      useModel(problem, fitted->model->linearisedAbout(about), fitted, journal);
      optimum = reached;
      return didNotConverge(&optimum);
    }
    still = std::abs(fitted->optimum.log_likelihood - before) < kImmaterial * share.now()
                ? still + 1
                : 0;
  }
}

/// Leaves a local optimum for a higher one, as long as there is one. A given start is climbed from
/// as it is, and points of linearisation do not carry over to another optimum.
void leaveLocalOptimum(const Problem& problem, const OptimisationOptions& options,
                       FittedModel* fitted, Journal* journal) {
  constexpr int kMostLeaps = 4;
  if (hasGivenParameters(problem) || fitted->model->isLocallyLinear()) return;
  for (int leap = 0; leap < kMostLeaps; ++leap) {
    Optimum& optimum = fitted->optimum;
    if (journal->progress.searchEnds() || optimum.iterations >= options.max_iterations) return;
    const std::optional<ModelParameters> higher = higherElsewhere(problem, *fitted, options);
    if (!higher) return;
    const Optimum before = optimum;
    optimum.point = *higher;
    optimise(problem, options, journal->passes, fitted);
    if (optimum.log_likelihood > before.log_likelihood) continue;
    optimum = before;
    return;
  }
}

/// Whether a component has no experiment. It describes nothing, but with a mean far away its tiny
/// weight would free the others from a mean of zero.
bool hasEmptyComponent(const Mixture& mixture, int experiments) {
  constexpr double kFewest = 0.1;  // experiments
  return mixture.components() > 1 &&
         *std::min_element(mixture.weights.begin(), mixture.weights.end()) * experiments < kFewest;
}

void warnAboutFloor(const Mixture& mixture, const MatrixXd& floor, Journal* journal) {
  for (std::size_t i = 0; floor.size() > 0 && i < mixture.covariances.size(); ++i) {
    const SymmetricEigen eigen(mixture.covariances[i], floor);
    if (eigen.eigenvalues().minCoeff() > 1.01) continue;
    journal->warnings.push_back(
        "the covariance of component " + std::to_string(i + 1) +
        " is at its lower limit in some direction: the experiments hardly differ in this "
        "direction, or too few of them belong to the component");
  }
}

/// The optimum with as many components as the problem's configuration says.
FittedModel fitComponents(const Problem& problem, Journal* journal) {
  const Configuration& configuration = problem.configuration;
  FittedModel fitted;
  useModel(problem, buildModel(problem), &fitted, journal);
  requireEnoughSamples(problem, *fitted.model);
  if (problem.start.size() == fitted.model->parameterCount() && !hasGivenParameters(problem)) {
    if (auto at_start = linearisedAtStart(*fitted.model, problem.data.blocks, problem.data.count(),
                                          problem.start))
      useModel(problem, std::move(at_start), &fitted, journal);
  }
  const ModelParameters start = findStart(problem, *fitted.model, *fitted.likelihood, journal);
  fitted.components = givenMixture(problem).components() > 0 ? configuration.error_model.components
                                                             : start.mixture.components();
  fitted.optimum.point = start;
  auto about = linearisedToStart(problem, *fitted.model, start, journal);
  if (about) useModel(problem, std::move(about->model), &fitted, journal);
  if (configuration.estimation.max_iterations == 0) {
    const Statistics statistics = fitted.likelihood->statistics(start.parameters, false);
    fitted.optimum.log_likelihood = fitted.likelihood->expect(statistics, start).total();
    fitted.optimum.message = "evaluated at the start without optimising (max_iterations: 0)";
    return fitted;
  }
  OptimisationOptions options =
      optimisationOptions(configuration, Phase::optimum, &journal->progress);
  fitted.floor = covarianceFloor(start.mixture);
  options.floor = fitted.floor;
  optimiseToFixedPoint(problem, options, about ? about->points : MatrixXd(), &fitted, journal);
  return fitted;
}

}  // namespace

FittedModel fitModel(const Problem& problem, Journal* journal) {
  FittedModel fitted = fitComponents(problem, journal);
  const Configuration& configuration = problem.configuration;
  if (configuration.estimation.max_iterations == 0) return fitted;
  Problem fewer = problem;
  const bool are_chosen =
      configuration.error_model.components == kAutomatic && givenMixture(problem).components() == 0;
  while (are_chosen && hasEmptyComponent(fitted.optimum.point.mixture, problem.data.count())) {
    fewer.configuration.error_model.components = fitted.optimum.point.mixture.components() - 1;
    fitted = fitComponents(fewer, journal);
  }
  OptimisationOptions options =
      optimisationOptions(configuration, Phase::optimum, &journal->progress);
  options.floor = fitted.floor;
  leaveLocalOptimum(problem, options, &fitted, journal);
  fitted.optimum.point =
      withSortedTimeConstants(*fitted.model, configuration.error_model, fitted.optimum.point);
  warnAboutFloor(fitted.optimum.point.mixture, fitted.floor, journal);
  return fitted;
}

}  // namespace uncertainty_identification
