#include <cmath>
#include <optional>
#include <utility>

#include "estimation/excerpt.h"
#include "identification/mean_plant.h"
#include "identification/steps.h"
#include "identification/structure_fit.h"
#include "math/information_criterion.h"
#include "math/polynomial.h"
#include "uncertainty_identification/errors.h"

/// Offsets of the experiments' own in place of noise that lasts as long as they do.
namespace uncertainty_identification {
namespace {

/// Whether the noise hardly decays within the longest experiment: then it may only stand for an
/// operating point of each experiment, while the simulation stays at a common one.
bool noiseLasts(const FittedModel& fitted, const CheckedData& data) {
  constexpr double kPart = 3;  // the time constant is longer than one third of the experiment
  const NominalModel& nominal = fitted.model->nominal();
  const Eigen::VectorXd theta = fitted.optimum.point.parameters.head(nominal.parameterCount());
  const Eigen::VectorXd d = nominal.polynomials(theta).d;
  if (d.size() == 0) return false;
  const double slowest = roots(d).cwiseAbs().maxCoeff();
  return -std::log(slowest) * longestOf(data.experiments) < kPart;
}

/// Half the BIC, with a minus sign, of all samples: the first ones as well, whose levels offsets of
/// the experiments' own explain, at the price of a wide prior.
double scoreOf(const Problem& problem, const FittedModel& fitted) {
  const CheckedData& data = problem.data;
  const int varied = fitted.model->regressors();
  const auto components = static_cast<int>(fitted.optimum.point.mixture.means.size());
  const int mixture =
      varied == 0 ? 0 : mixtureParameters(problem.configuration, varied, components);
  const auto plant = problem.plant ? problem.plant->parameters.size() : 0;
  return fitted.optimum.log_likelihood -
         bicPenalty(fitted.model->parameterCount() + 1 + static_cast<double>(plant),
                    static_cast<double>(data.validSamples())) -
         bicPenalty(mixture, data.count());
}

SimulationFit simulated(const Problem& problem, const FittedModel& fitted) {
  const ModelParameters& point = fitted.optimum.point;
  return fitOf(problem, meanPlant(*fitted.model, point), offsetOf(problem, *fitted.model, point));
}

/// Marks the offsets of each experiment's own as chosen, also where they had seemed worse.
void markOwnOffsets(std::vector<Candidate>* candidates) {
  for (Candidate& each : *candidates)
    if (each.choice == "offsets") each.chosen = each.description != "common";
}

/// The plant's orders and the model around it, chosen one after the other.
FittedModel chosenModel(const Configuration& asked, Problem* problem, Journal* journal) {
  choosePlant(problem, journal);
  return fitChosen(asked, problem, journal);
}

}  // namespace

FittedModel fitWithOffsets(const Configuration& asked, Problem* problem, Journal* journal) {
  Problem own = *problem;
  const std::vector<Candidate> candidates_before = journal->candidates;
  const std::vector<std::string> warnings_before = journal->warnings;
  FittedModel fitted = chosenModel(asked, problem, journal);
  const Offsets chosen = problem->configuration.estimation.offsets;
  if (asked.estimation.offsets != Offsets::automatic || chosen != Offsets::estimate ||
      !mayHaveOwnOffsets(own) || !noiseLasts(fitted, own.data) || journal->progress.searchEnds())
    return fitted;
  own.configuration.estimation.offsets = Offsets::per_experiment;
  std::vector<Candidate> candidates = std::exchange(journal->candidates, candidates_before);
  std::vector<std::string> warnings = std::exchange(journal->warnings, warnings_before);
  try {
    FittedModel other = chosenModel(asked, &own, journal);
    if (scoreOf(own, other) > scoreOf(*problem, fitted) &&
        !simulatesWorse(simulated(own, other), simulated(*problem, fitted))) {
      takeOver(own, problem);
      markOwnOffsets(&journal->candidates);
      return other;
    }
  } catch (const DataError&) {
    // Not every data set allows this model; the one before stands.
  }
  journal->candidates = std::move(candidates);
  journal->warnings = std::move(warnings);
  return fitted;
}

}  // namespace uncertainty_identification
