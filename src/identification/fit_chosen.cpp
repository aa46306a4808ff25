#include <cmath>
#include <utility>

#include "identification/mean_plant.h"
#include "identification/steps.h"
#include "math/information_criterion.h"

/// The model of the structure that is chosen from the data.
namespace uncertainty_identification {
namespace {

/// Takes over what was chosen of another problem of the same data.
void takeOver(const Problem& other, Problem* problem) {
  problem->configuration = other.configuration;
  problem->plant = other.plant;
  problem->start = other.start;
}

/// The model of the chosen structure around the plant that was fitted alone.
FittedModel fitAround(const Problem& around, const Configuration& asked, Problem* problem,
                      Journal* journal) {
  takeOver(around, problem);
  adopt(chooseAroundPlant(around, asked, journal), problem);
  problem->plant = describePlant(*problem, journal);
  return fitModel(*problem, journal);
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
  if (!could_be_alone || simulatesByOwnPlants(*problem, fitted, *around.plant) ||
      simulatesAsWellAsAlone(*problem, *fitted.model, fitted.optimum.point, *around.plant, journal))
    return fitted;
  const Problem jointly = *problem;
  std::vector<Candidate> of_joint = journal->candidates;
  std::vector<std::string> warned = journal->warnings;
  journal->candidates.resize(candidates);
  journal->warnings.resize(warnings);
  FittedModel alone = fitAround(around, asked, problem, journal);
  // Beside the long free response of an integrator, rounding may leave nothing of a small residual.
  if (!std::isfinite(alone.optimum.log_likelihood)) {
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

double bicOf(const Problem& problem, const FittedModel& fitted) {
  const double parameters = fitted.model->parameterCount() + 1;
  return -2 * (fitted.optimum.log_likelihood -
               bicPenalty(parameters, static_cast<double>(problem.data.validSamples())));
}

double fitOf(const Problem& problem, const FittedModel& fitted) {
  const ModelParameters& point = fitted.optimum.point;
  return meanPlantFit(*fitted.model, point, offsetOf(problem, *fitted.model, point),
                      problem.configuration.estimation, problem.data.experiments)
      .pooled;
}

}  // namespace

void adopt(const ModelChoice& choice, Problem* problem) {
  problem->configuration = choice.configuration;
  problem->start = choice.start;
  if (!choice.plant_is_fixed) problem->plant.reset();
}

FittedModel fitChosen(const Configuration& asked, Problem* problem, Journal* journal) {
  constexpr double kHardlyWorse = 3;  // [% of fit]
  if (problem->data.count() > 1 || !asked.nominal_model.orders_auto)
    return fitChosen(asked, Orders::of_simulation, problem, journal);
  Problem other = *problem;
  const std::vector<Candidate> candidates = journal->candidates;
  const std::vector<std::string> warnings = journal->warnings;
  FittedModel jointly = fitChosen(asked, Orders::of_likelihood, problem, journal);
  if (journal->progress.searchEnds()) return jointly;
  std::vector<Candidate> of_joint = std::exchange(journal->candidates, candidates);
  std::vector<std::string> warned = std::exchange(journal->warnings, warnings);
  FittedModel simulated = fitChosen(asked, Orders::of_simulation, &other, journal);
  // A noise model may describe what a plant lacks, at a high likelihood.
  if (bicOf(other, simulated) < bicOf(*problem, jointly) &&
      fitOf(other, simulated) > fitOf(*problem, jointly) - kHardlyWorse) {
    takeOver(other, problem);
    return simulated;
  }
  journal->candidates = std::move(of_joint);
  journal->warnings = std::move(warned);
  return jointly;
}

}  // namespace uncertainty_identification
