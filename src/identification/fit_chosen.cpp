#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <utility>

#include "identification/mean_plant.h"
#include "identification/steps.h"
#include "math/information_criterion.h"
#include "uncertainty_identification/errors.h"

/// The model of the structure that is chosen from the data.
namespace uncertainty_identification {
namespace {

/// The model of the chosen structure around the plant that was fitted alone.
FittedModel fitAround(const Problem& around, const Configuration& asked, Problem* problem,
                      Journal* journal) {
  takeOver(around, problem);
  adopt(chooseAroundPlant(around, asked, journal), problem);
  problem->plant = describePlant(*problem, journal);
  return fitModel(*problem, journal);
}

/// Whether a joint fit is kept although there is a plant that was fitted alone: it simulates as
/// well. A joint fit of few experiments that did not converge must not simulate worse by more than
/// rounding and chance, unless modes differ, whose mean plant always simulates worse.
bool standsBeside(const Problem& problem, const FittedModel& fitted, const FittedPlant& alone,
                  Journal* journal) {
  constexpr double kNoticeable = 1;  // [% of fit]
  const ModelParameters& point = fitted.optimum.point;
  const double offset = plantOf(*fitted.model, point).offset;
  const bool are_modes = problem.configuration.nominal_model.structure == Structure::modal;
  if (!are_modes && !areMany(problem, *fitted.model) &&
      fitted.optimum.termination != Termination::converged &&
      fitOf(problem, meanPlant(*fitted.model, point), offset).pooled <
          fitOf(problem, alone.polynomials, alone.offset).pooled - kNoticeable)
    return false;
  return simulatesByOwnPlants(problem, fitted, alone) ||
         simulatesAsWellAsAlone(problem, *fitted.model, point, alone, journal);
}

/// The model of the chosen structure. Where Go was fitted jointly, but alone simulates the data
/// better, the model around the plant that was fitted alone, if there is one.
FittedModel fitChosen(const Configuration& asked, Orders orders, Problem* problem,
                      Journal* journal) {
  const Problem around = *problem;
  const std::size_t candidates = journal->candidates.size(), warnings = journal->warnings.size();
  adopt(chooseModel(*problem, asked, orders, journal), problem);
  if (problem->plant) problem->plant = describePlant(*problem, journal);
  FittedModel fitted = fitModel(*problem, journal);
  const bool could_be_alone = around.plant && !problem->plant && !journal->progress.searchEnds();
  if (!could_be_alone || standsBeside(*problem, fitted, *around.plant, journal)) return fitted;
  const Problem jointly = *problem;
  std::vector<Candidate> of_joint = journal->candidates;
  std::vector<std::string> warned = journal->warnings;
  journal->candidates.resize(candidates);
  journal->warnings.resize(warnings);
  FittedModel alone = fitAround(around, asked, problem, journal);
  // Beside the long free response of an integrator, rounding may leave nothing of a small residual.
  if (!std::isfinite(alone.optimum.log_likelihood) || alone.optimum.is_lost) {
    takeOver(jointly, problem);
    journal->candidates = std::move(of_joint);
    journal->warnings = std::move(warned);
    return fitted;
  }
  journal->warnings.push_back(
      "Go was fitted to its simulation alone: fitted together with the noise and the differences "
      "between the experiments it simulates worse, so the plant may not be linear, or the data "
      "are too few");
  return alone;
}

/// What one way to choose the orders comes to, with what it wrote into the journal.
struct Trial {
  Problem problem;
  std::optional<FittedModel> fitted;  ///< none where the data allow none
  std::exception_ptr error;           ///< then why
  std::vector<Candidate> candidates;
  std::vector<std::string> warnings;
};

Trial tried(const Configuration& asked, Orders orders, const Problem& problem, Journal* journal) {
  const std::vector<Candidate> candidates = journal->candidates;
  const std::vector<std::string> warnings = journal->warnings;
  Trial trial{problem, {}, {}, {}, {}};
  try {
    trial.fitted = fitChosen(asked, orders, &trial.problem, journal);
  } catch (const DataError&) {
    trial.error = std::current_exception();
  }
  trial.candidates = std::exchange(journal->candidates, candidates);
  trial.warnings = std::exchange(journal->warnings, warnings);
  return trial;
}

/// Infinity where the model cannot be evaluated.
double bicOf(const Trial& trial) {
  const std::optional<FittedPlant>& plant = trial.problem.plant;
  const double parameters = trial.fitted->model->parameterCount() + 1 +
                            static_cast<double>(plant ? plant->parameters.size() : 0);
  const auto samples = static_cast<double>(trial.problem.data.validSamples());
  const double bic = 2 * (bicPenalty(parameters, samples) - trial.fitted->optimum.log_likelihood);
  return std::isfinite(bic) && !trial.fitted->optimum.is_lost
             ? bic
             : std::numeric_limits<double>::infinity();
}

/// [%] of the record.
double fitOf(const Trial& trial) {
  const FittedModel& fitted = *trial.fitted;
  const ModelParameters& point = fitted.optimum.point;
  return meanPlantFit(*fitted.model, point, offsetOf(trial.problem, *fitted.model, point),
                      trial.problem.configuration.estimation, trial.problem.data.experiments)
      .pooled;
}

/// The one of less BIC, unless it simulates worse: a noise model may describe what a plant lacks,
/// at a high likelihood.
Trial& better(Trial& one, Trial& other) {
  constexpr double kHardlyWorse = 3;  // [% of fit]
  if (!one.fitted || !other.fitted) return one.fitted ? one : other;
  Trial& likelier = bicOf(one) <= bicOf(other) ? one : other;
  Trial& second = &likelier == &one ? other : one;
  const bool simulates = fitOf(likelier) > fitOf(second) - kHardlyWorse;
  return simulates || std::isinf(bicOf(second)) ? likelier : second;
}

}  // namespace

void takeOver(const Problem& other, Problem* problem) {
  problem->configuration = other.configuration;
  problem->plant = other.plant;
  problem->start = other.start;
  problem->reached = other.reached;
  problem->points = other.points;
}

void adopt(const ModelChoice& choice, Problem* problem) {
  problem->configuration = choice.configuration;
  problem->start = choice.start;
  problem->reached = choice.reached;
  problem->points = choice.points;
  if (!choice.plant_is_fixed) problem->plant.reset();
}

FittedModel fitChosen(const Configuration& asked, Problem* problem, Journal* journal) {
  const bool is_free =
      asked.nominal_model.orders_auto && asked.nominal_model.fit == PlantFit::likelihood;
  if (problem->data.count() > 1 || !is_free)
    return fitChosen(asked, Orders::of_simulation, problem, journal);
  Trial jointly = tried(asked, Orders::of_likelihood, *problem, journal);
  const bool is_hurried = jointly.fitted && journal->progress.searchEnds();
  Trial simulated = is_hurried ? Trial{*problem, {}, {}, {}, {}}
                               : tried(asked, Orders::of_simulation, *problem, journal);
  Trial& chosen = better(jointly, simulated);
  if (!chosen.fitted) std::rethrow_exception(chosen.error);
  takeOver(chosen.problem, problem);
  journal->candidates = std::move(chosen.candidates);
  journal->warnings = std::move(chosen.warnings);
  return std::move(*chosen.fitted);
}

}  // namespace uncertainty_identification
