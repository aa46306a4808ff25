#include "uncertainty_identification/identifier.h"

#include <algorithm>

#include "data/stray_readings.h"
#include "data/thinning.h"
#include "identification/identify.h"
#include "math/interruption.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// The experiments that the estimate was fitted to, in its order and at its sample time, without
/// stray readings.
std::vector<Experiment> usedExperiments(const Estimate& estimate,
                                        const std::vector<Experiment>& experiments) {
  std::vector<Experiment> used;
  std::size_t next = 0;
  for (const Experiment& experiment : experiments) {
    if (next == estimate.experiments.size()) break;
    if (experiment.id != estimate.experiments[next].id) continue;
    used.push_back(experiment);
    ++next;
  }
  const StrayReadings stray = strayReadings(used, estimate.configuration.limits.max_stray);
  return thinned(without(stray, std::move(used)), estimate.configuration.estimation.thinning);
}

/// A model identified without the experiments k, k + folds, ..., and the scores of these.
struct Fold {
  int number;
  FoldModel model;
  std::vector<double> scores;
};

Fold fitFold(const Request& request, const std::vector<Experiment>& experiments, int number,
             int folds) {
  std::vector<Experiment> others, own;
  for (std::size_t r = 0; r < experiments.size(); ++r)
    (static_cast<int>(r) % folds == number ? own : others).push_back(experiments[r]);
  Fold fold{number, identifyPlant(request, others), {}};
  fold.scores = predictionScores(fold.model, request.configuration.estimation, own);
  return fold;
}

std::string leftOut(int number, int folds, const DataError& error) {
  return "fold " + std::to_string(number + 1) + " of " + std::to_string(folds) +
         " could not be fitted, and its experiments are left out of the calibration: " +
         error.what();
}

/// The scores of the experiments whose fold was fitted, in the order of the experiments.
PredictionCalibration calibrationOf(const std::vector<Fold>& folds, int total, int experiments) {
  PredictionCalibration calibration;
  for (const Fold& fold : folds) calibration.folds.push_back(fold.model);
  for (int r = 0; r < experiments; ++r) {
    const auto fold = std::find_if(folds.begin(), folds.end(),
                                   [&](const Fold& one) { return one.number == r % total; });
    if (fold == folds.end()) continue;
    calibration.fold.push_back(static_cast<int>(fold - folds.begin()));
    calibration.scores.push_back(fold->scores[static_cast<std::size_t>(r / total)]);
  }
  return calibration;
}

/// The radii below which, according to the identified model, the scores of the shares `levels` of
/// experiments lie.
std::vector<double> modelRadii(const Estimate& estimate,
                               const std::vector<Experiment>& experiments) {
  const std::vector<double> expected = expectedScores(estimate, experiments);
  std::vector<double> radii;
  for (double level : estimate.configuration.bounds.levels) {
    const auto rank = static_cast<std::size_t>(level * static_cast<double>(expected.size()));
    radii.push_back(expected[std::min(rank, expected.size() - 1)]);
  }
  return radii;
}

/// Fits each fold. `request` has the progress of all folds together. Throws CancelledError, and
/// DataError if fewer than two folds can be fitted.
PredictionCalibration calibrated(const Request& request, const Estimate& estimate,
                                 const std::vector<Experiment>& experiments) {
  Configuration configuration = estimate.configuration;
  configuration.estimation.thinning = 1;     // `used` is thinned,
  configuration.limits.max_stray = 0;        // and has no stray readings,
  configuration.limits.max_missing = 0.999;  // of which there may be more than a user accepts
  const std::vector<Experiment> used = usedExperiments(estimate, experiments);
  const int count = static_cast<int>(used.size());
  const int folds = std::min(configuration.bounds.folds, count);
  if (folds < 2) return {};
  std::vector<Fold> fitted;
  std::optional<DataError> failure;
  std::vector<std::string> warnings;
  for (int k = 0; k < folds; ++k) {
    const auto of_fold = [&](const Progress& now) {
      return request.progress({now.phase, (k + now.fraction) / folds, now.log_likelihood});
    };
    try {
      fitted.push_back(
          fitFold({configuration, request.nominal_model, of_fold, &estimate}, used, k, folds));
    } catch (const DataError& error) {
      failure = error;
      warnings.push_back(leftOut(k, folds, error));
    }
    checkpoint();
  }
  if (fitted.size() < 2) throw *failure;
  PredictionCalibration calibration = calibrationOf(fitted, folds, count);
  calibration.warnings = std::move(warnings);
  calibration.model_radius = modelRadii(estimate, used);
  calibrate(configuration.bounds.levels, &calibration);
  return calibration;
}

}  // namespace

Identifier::Identifier(Configuration configuration) : configuration_(std::move(configuration)) {
  configuration_.validate();
}

Identifier::Identifier(Configuration configuration, NominalModelFactory nominal_model)
    : Identifier(std::move(configuration)) {
  NominalModelOptions& options = configuration_.nominal_model;
  options.orders_auto = false;  // the caller's model has its own
  if (options.fit != PlantFit::likelihood) {
    throw ConfigurationError(
        "nominal_model.fit: found simulation, which is available for Box-Jenkins models only; use "
        "likelihood with a model of your own");
  }
  nominal_model_ = std::move(nominal_model);
}

Estimate Identifier::identify(const std::vector<Experiment>& experiments,
                              const std::vector<Experiment>& validation,
                              const ProgressCallback& progress) const {
  return uncertainty_identification::identify({configuration_, nominal_model_, progress},
                                              experiments, validation);
}

Estimate Identifier::reidentify(const Estimate& previous,
                                const std::vector<Experiment>& experiments,
                                const ProgressCallback& progress) const {
  if (!previous.usable()) return identify(experiments, {}, progress);
  Configuration configuration = previous.configuration;
  int& thinning = configuration.estimation.thinning;
  thinning = std::max(thinning, 1);  // results of versions that did not thin do not state it
  return uncertainty_identification::identify(
      {std::move(configuration), nominal_model_, progress, &previous}, experiments, {});
}

PredictionCalibration Identifier::calibrate(const Estimate& estimate,
                                            const std::vector<Experiment>& experiments,
                                            const ProgressCallback& progress) const {
  bool cancelled = false;
  Progress last{"calibrating", 0, {}};
  const auto asked_to_end = [&] {
    cancelled = cancelled || (progress && !progress(last));
    return cancelled;
  };
  const Interruption interruption(asked_to_end);
  try {
    return calibrated({configuration_, nominal_model_,
                       [&](const Progress& now) {
                         last.fraction = now.fraction;
                         last.log_likelihood = now.log_likelihood;
                         return !asked_to_end();
                       }},
                      estimate, experiments);
  } catch (const CancelledError&) {
    if (!cancelled) throw;  // somebody further out has cancelled
    return {};
  }
}

}  // namespace uncertainty_identification
