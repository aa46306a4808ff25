#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "estimation/excerpt.h"
#include "identification/mean_plant.h"
#include "identification/steps.h"
#include "identification/structure_fit.h"
#include "math/constants.h"
#include "math/information_criterion.h"
#include "math/polynomial.h"
#include "residual_tests/residual_tests.h"
#include "uncertainty_identification/errors.h"

/// Offsets of the experiments' own in place of noise that lasts as long as they do.
namespace uncertainty_identification {
namespace {

/// Whether the noise hardly decays within the longest experiment, nor swings twice: then it may
/// only stand for an operating point of each experiment, while the simulation stays at a common
/// one. Where A is a part of H, such noise may be the plant's.
bool noiseLasts(const FittedModel& fitted, const Configuration& configuration,
                const CheckedData& data) {
  constexpr double kPart = 3;  // the time constant is longer than one third of the experiment
  const Structure structure = configuration.nominal_model.structure;
  if (structure == Structure::arx || structure == Structure::armax) return false;
  const NominalModel& nominal = fitted.model->nominal();
  const Eigen::VectorXd theta = fitted.optimum.point.parameters.head(nominal.parameterCount());
  const Eigen::VectorXd d = nominal.polynomials(theta).d;
  const Eigen::VectorXcd all = roots(d);
  const int longest = longestOf(data.experiments);
  return std::any_of(all.data(), all.data() + all.size(), [&](const std::complex<double>& root) {
    const std::complex<double> rate = std::log(root) * static_cast<double>(longest);
    return -rate.real() < kPart && std::abs(rate.imag()) < 4 * kPi;
  });
}

/// Log-likelihood of all samples: the first ones as well, whose levels offsets of the experiments'
/// own explain, at the price of a wide prior about zero.
double logLikelihoodOf(const FittedModel& fitted) {
  const Optimum& optimum = fitted.optimum;
  return std::isfinite(optimum.log_likelihood) && !optimum.is_lost
             ? optimum.log_likelihood
             : -std::numeric_limits<double>::infinity();
}

/// What is compared, with the BIC of all samples.
Candidate candidateOf(const Problem& problem, const FittedModel& fitted) {
  const CheckedData& data = problem.data;
  const int varied = fitted.model->regressors();
  const auto components = static_cast<int>(fitted.optimum.point.mixture.means.size());
  const int mixture =
      varied == 0 ? 0 : mixtureParameters(problem.configuration, varied, components);
  const auto plant = problem.plant ? static_cast<int>(problem.plant->parameters.size()) : 0;
  const int parameters = fitted.model->parameterCount() + 1 + plant;
  const double log_likelihood = logLikelihoodOf(fitted);
  const double bic = 2 * (bicPenalty(parameters, static_cast<double>(data.validSamples())) +
                          bicPenalty(mixture, data.count()) - log_likelihood);
  const bool own = problem.configuration.estimation.offsets == Offsets::per_experiment;
  return {"offsets, as noise lasts",
          own ? "of each experiment" : "common",
          parameters + mixture,
          log_likelihood,
          bic,
          {},
          false,
          {}};
}

SimulationFit simulated(const Problem& problem, const FittedModel& fitted) {
  const ModelParameters& point = fitted.optimum.point;
  return fitOf(problem, meanPlant(*fitted.model, point), offsetOf(problem, *fitted.model, point));
}

/// The least p-value of the tests of the residuals.
double leastPValue(const FittedModel& fitted, const CheckedData& data) {
  const NominalModel& nominal = fitted.model->nominal();
  const Eigen::VectorXd& parameters = fitted.optimum.point.parameters;
  const Polynomials polynomials = nominal.polynomials(parameters.head(nominal.parameterCount()));
  const ResidualTests tests = residualTests(*fitted.model, data.blocks, parameters, &polynomials);
  return std::min({tests.whiteness_p_value, tests.independence_p_value, tests.linearity_p_value});
}

/// Whether the tests find nothing wrong with offsets of the experiments' own, and very much with
/// one in common. Where gains differ about an operating point, no mean plant simulates levels of
/// their own as well as one level that all pass through, and the noise stands for the rest.
bool onlyOwnAgree(const FittedModel& own, const FittedModel& common, const CheckedData& data) {
  constexpr double kAgrees = 1e-3, kContradicts = 1e-6;
  return leastPValue(common, data) < kContradicts && leastPValue(own, data) > kAgrees;
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
  const EstimationOptions& options = problem->configuration.estimation;
  const bool has_prior = options.initial_precision > 0;
  if (asked.estimation.offsets != Offsets::automatic || options.offsets != Offsets::estimate ||
      !has_prior || !mayHaveOwnOffsets(own) ||
      !noiseLasts(fitted, problem->configuration, own.data) || !journal->progress.allowsAnother())
    return fitted;
  own.configuration.estimation.offsets = Offsets::per_experiment;
  std::vector<Candidate> candidates = std::exchange(journal->candidates, candidates_before);
  std::vector<std::string> warnings = std::exchange(journal->warnings, warnings_before);
  Candidate common = candidateOf(*problem, fitted);
  try {
    FittedModel other = chosenModel(asked, &own, journal);
    Candidate each = candidateOf(own, other);
    each.chosen = onlyOwnAgree(other, fitted, own.data) ||
                  (*each.bic < *common.bic &&
                   !simulatesWorse(simulated(own, other), simulated(*problem, fitted)));
    common.chosen = !each.chosen;
    std::vector<Candidate>* of_chosen = each.chosen ? &journal->candidates : &candidates;
    of_chosen->insert(of_chosen->end(), {common, each});
    if (each.chosen) {
      takeOver(own, problem);
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
