#include "uncertainty_identification/identifier.h"

#include <algorithm>

#include "identification/identification.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// Those that passed the checks, in the order of the estimate.
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
  return used;
}

}  // namespace

Identifier::Identifier(Configuration configuration) : configuration_(std::move(configuration)) {
  configuration_.validate();
}

Identifier::Identifier(Configuration configuration, NominalModelFactory nominal_model)
    : Identifier(std::move(configuration)) {
  const NominalModelOptions& options = configuration_.nominal_model;
  if (options.orders_auto) {
    throw ConfigurationError(
        "nominal_model.orders: found auto, which chooses among Box-Jenkins models; leave it out "
        "with a model of your own");
  }
  if (options.fit != PlantFit::likelihood) {
    throw ConfigurationError(
        "nominal_model.fit: found simulation, which is for Box-Jenkins models; a model of your "
        "own takes likelihood");
  }
  nominal_model_ = std::move(nominal_model);
}

Estimate Identifier::identify(const std::vector<Experiment>& experiments,
                              const std::vector<Experiment>& validation,
                              const ProgressCallback& progress) const {
  return Identification(configuration_, nominal_model_, progress)
      .run(experiments, validation, nullptr);
}

Estimate Identifier::reidentify(const Estimate& previous,
                                const std::vector<Experiment>& experiments,
                                const ProgressCallback& progress) const {
  if (!previous.usable()) return identify(experiments, {}, progress);
  return Identification(previous.configuration, nominal_model_, progress)
      .run(experiments, {}, &previous);
}

PredictionCalibration Identifier::calibrate(const Estimate& estimate,
                                            const std::vector<Experiment>& experiments,
                                            const ProgressCallback& progress) const {
  const std::vector<Experiment> used = usedExperiments(estimate, experiments);
  const int count = static_cast<int>(used.size());
  const int folds = std::min(estimate.configuration.bounds.folds, count);
  PredictionCalibration calibration;
  if (folds < 2) return calibration;
  const EstimationOptions& options = estimate.configuration.estimation;
  std::vector<double> scores(used.size());
  bool cancelled = false;
  for (int k = 0; k < folds && !cancelled; ++k) {
    std::vector<Experiment> others, own;
    for (int r = 0; r < count; ++r)
      (r % folds == k ? own : others).push_back(used[static_cast<std::size_t>(r)]);
    const auto of_fold = [&](const Progress& at) {
      cancelled =
          progress && !progress({"calibrating", (k + at.fraction) / folds, at.log_likelihood});
      return !cancelled;
    };
    calibration.folds.push_back(
        Identification(estimate.configuration, nominal_model_, of_fold).plant(others, estimate));
    const std::vector<double> left = predictionScores(calibration.folds.back(), options, own);
    for (std::size_t j = 0; j < left.size(); ++j)
      scores[static_cast<std::size_t>(k) + j * static_cast<std::size_t>(folds)] = left[j];
  }
  if (cancelled) return {};
  calibration.scores = std::move(scores);
  for (int r = 0; r < count; ++r) calibration.fold.push_back(r % folds);
  const std::vector<double> expected = expectedScores(estimate, used);
  for (double level : estimate.configuration.bounds.levels) {
    const auto rank = static_cast<std::size_t>(level * static_cast<double>(expected.size()));
    calibration.model_radius.push_back(expected[std::min(rank, expected.size() - 1)]);
  }
  uncertainty_identification::calibrate(estimate.configuration.bounds.levels, &calibration);
  return calibration;
}

}  // namespace uncertainty_identification
