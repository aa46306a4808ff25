#include "uncertainty_identification/baselines/baseline.h"

#include <chrono>

#include "bounds/frequency_grid.h"
#include "data/experiment_checks.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// The experiments that pass the checks.
std::vector<Experiment> usable(const std::vector<Experiment>& experiments,
                               const CheckReport& checked) {
  std::vector<Experiment> used;
  for (int r : checked.usable) used.push_back(experiments[static_cast<std::size_t>(r)]);
  if (used.empty()) {
    throw DataError("no usable experiment is left" +
                    (checked.rejected.empty() ? "" : ": " + checked.rejected.front().reason));
  }
  return used;
}

}  // namespace

const EnumNames<BaselineMethod>& enumNames(BaselineMethod) {
  static const EnumNames<BaselineMethod> kNames{{BaselineMethod::pem, "pem"},
                                                {BaselineMethod::mem, "mem"}};
  return kNames;
}

BaselineResult identifyBaseline(BaselineMethod method, const Configuration& configuration,
                                const std::vector<Experiment>& experiments) {
  const auto began = std::chrono::steady_clock::now();
  const CheckReport checked =
      checkExperiments(experiments, configuration.limits, {}, configuration.sample_time);
  const std::vector<Experiment> used = usable(experiments, checked);
  const double sample_time = used.front().sample_time;
  const PredictionErrorFits fits = fitExperiments(
      configuration, makeNominalModel(configuration.nominal_model, sample_time), used);
  BaselineResult result{meanEstimate(configuration, fits, used), {}};
  Baseline& baseline = result.baseline;
  baseline.method = method;
  baseline.fits = fits.fits;
  baseline.mean = fits.mean;
  baseline.deviation = fits.covariance.diagonal().cwiseSqrt();
  PlantSamples plants = plantsOf(fits, sample_time);
  if (method == BaselineMethod::mem) {
    const ModelErrorModels models = modelErrorModels(configuration, fits, used);
    baseline.error_models = models.fits;
    plants = plantsOf(models, sample_time);
  }
  const BoundsOptions& bounds = configuration.bounds;
  if (bounds.frequencies > 0) {
    baseline.omega = bounds.grid.size() > 0
                         ? bounds.grid
                         : frequencyGrid(result.estimate.nominal_model, bounds.frequencies);
    baseline.magnitude_bands = magnitudeBands(plants, baseline.omega, bounds.levels);
  }
  Estimate& estimate = result.estimate;
  estimate.rejected.insert(estimate.rejected.begin(), checked.rejected.begin(),
                           checked.rejected.end());
  estimate.warnings = checked.warnings;
  estimate.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return result;
}

}  // namespace uncertainty_identification
