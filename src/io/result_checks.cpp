#include "io/result_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "configuration/require.h"
#include "math/polynomial.h"
#include "math/symmetric_eigen.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

template <class List>
void requireLength(const std::string& key, const List& list, Index length) {
  const auto found = static_cast<Index>(list.size());
  require(found == length, key, std::to_string(found) + " entries", std::to_string(length));
}

/// What could not be computed is empty.
void requireLengthUnlessEmpty(const std::string& key, const VectorXd& values, Index samples) {
  if (values.size() > 0) requireLength(key, values, samples);
}

void requireFinite(const std::string& key, const VectorXd& values) {
  require(values.allFinite(), key, "an entry that is not finite", "finite numbers");
}

/// Unknown covariances are empty, or hold entries that are not finite.
void requireCovariance(const std::string& key, const MatrixXd& covariance) {
  constexpr double kRounding = 1e-6;  // relative to the largest entry
  require(
      covariance.rows() == covariance.cols(), key,
      std::to_string(covariance.rows()) + " x " + std::to_string(covariance.cols()) + " entries",
      "a square matrix");
  if (covariance.size() == 0 || !covariance.allFinite()) return;
  const double rounding = kRounding * covariance.cwiseAbs().maxCoeff();
  require((covariance - covariance.transpose()).cwiseAbs().maxCoeff() <= rounding, key,
          "entries that differ across the diagonal", "a symmetric matrix");
  require(SymmetricEigen(covariance).eigenvalues().minCoeff() >= -rounding, key,
          "a negative variance", "a positive semidefinite matrix");
}

void requireModel(const NominalModelEstimate& model) {
  constexpr int kLongestDelay = 100000;  // [samples] longer than any that can be configured
  const std::string at = "nominal_model.";
  require(model.sample_time > 0 && std::isfinite(model.sample_time), at + "sample_time",
          model.sample_time, "above 0");
  requireRange(at + "delay", model.delay, 0, kLongestDelay);
  requireFinite(at + "b", model.b);
  requireFinite(at + "a", model.a);
  requireFinite(at + "c", model.c);
  requireFinite(at + "d", model.d);
  requireCovariance(at + "covariance", model.covariance);
  if (model.covariance.size() > 0)
    requireLength(at + "parameters", model.parameters, model.covariance.rows());
}

/// A component that holds no experiment may have the weight zero.
void requireMixture(Mixture mixture) {
  for (double& weight : mixture.weights)
    if (weight == 0) weight = std::numeric_limits<double>::min();
  mixture.validate("error_model");
}

void requireErrorModel(const ErrorModelEstimate& model) {
  model.options.validate();
  requireMixture(model.mixture);
  const int n = model.mixture.dimension();
  if (n == 0 && model.T.size() == 0) return;
  require(model.T.rows() == model.options.taps && model.T.cols() == n, "error_model.T",
          std::to_string(model.T.rows()) + " x " + std::to_string(model.T.cols()) + " entries",
          std::to_string(model.options.taps) + " rows (taps) of " + std::to_string(n) +
              " (as the means)");
  require(model.T.allFinite(), "error_model.T", "an entry that is not finite", "finite numbers");
}

void requireStructureError(const StructureError& error) {
  const std::string at = "structure_error.";
  const auto& omega = error.omega;
  requireLength(at + "relative", error.relative, omega.size());
  if (omega.size() == 0) return;
  requireFinite(at + "omega", omega);
  requireFinite(at + "relative", error.relative);
  const bool ascending = std::is_sorted(omega.data(), omega.data() + omega.size());
  require(ascending && omega[0] > 0, at + "omega", "frequencies that do not ascend from above 0",
          "ascending ones");
  require(error.relative.minCoeff() >= 0, at + "relative", "a negative error", "0 or more");
}

void requireExperiments(const Estimate& estimate) {
  require(estimate.experiment_count >= 0, "experiments.count", estimate.experiment_count,
          "0 or more");
  const Mixture& mixture = estimate.error_model.mixture;
  for (std::size_t i = 0; i < estimate.experiments.size(); ++i) {
    const ExperimentEstimate& experiment = estimate.experiments[i];
    const std::string at = "experiments.estimates[" + std::to_string(i) + "].";
    if (!experiment.responsibilities.empty())
      requireLength(at + "responsibilities", experiment.responsibilities, mixture.components());
    requireLengthUnlessEmpty(at + "error_mean", experiment.error_mean, mixture.dimension());
  }
}

void requireBands(const std::string& key, const Bands& bands, std::size_t levels, Index points) {
  if (bands.empty() && bands.simultaneous.empty()) return;
  for (const auto& [name, list] : {std::make_pair(".pointwise", &bands.pointwise),
                                   std::make_pair(".simultaneous", &bands.simultaneous)}) {
    requireLength(key + name, *list, static_cast<Index>(levels));
    for (const Band& band : *list) {
      requireLength(key + name + ".lower", band.lower, points);
      requireLength(key + name + ".upper", band.upper, points);
    }
  }
}

void requireBands(const std::string& key, const UncertaintyBands& bands, std::size_t levels,
                  Index points) {
  requireBands(key + ".mixture", bands.mixture, levels, points);
  requireBands(key + ".total", bands.total, levels, points);
}

void requireCalibration(const PredictionCalibration& calibration) {
  const std::string at = "bounds.prediction.";
  const auto levels = static_cast<Index>(calibration.levels.size());
  requireLength(at + "guaranteed", calibration.guaranteed, levels);
  requireLength(at + "radius", calibration.radius, levels);
  requireLength(at + "model_radius", calibration.model_radius, levels);
  requireLength(at + "scores", calibration.scores, static_cast<Index>(calibration.fold.size()));
  for (const int fold : calibration.fold)
    requireRange(at + "fold", fold, 0, static_cast<int>(calibration.folds.size()) - 1);
}

void requireCurve(const std::string& key, const CurvePicture& curve) {
  const auto points = static_cast<Index>(curve.signal.size());
  requireLength(key + ".value", curve.value, points);
  requireLength(key + ".lower_90", curve.lower_90, points);
  requireLength(key + ".upper_90", curve.upper_90, points);
}

}  // namespace

void requireConsistent(const Estimate& estimate) {
  requireErrorModel(estimate.error_model);
  if (estimate.nominal_model.b.size() > 0) requireModel(estimate.nominal_model);
  requireCovariance("joint_covariance", estimate.joint_covariance);
  requireExperiments(estimate);
  requireStructureError(estimate.structure_error);
  requireLength("validation.simulation_fit_percent", estimate.validation.simulation_fit_percent,
                static_cast<Index>(estimate.validation.experiments.size()));
}

void requireStableNoise(const NominalModelEstimate& model) {
  const std::string found = "a polynomial with a root on or outside the unit circle",
                    allowed = "a stable one";
  require(isStable(model.c), "nominal_model.c", found, allowed);
  require(isStable(model.d), "nominal_model.d", found, allowed);
}

void requireConsistent(const Bounds& bounds) {
  const FrequencyBounds& frequency = bounds.frequency;
  const Index points = frequency.omega.size();
  requireLength("bounds.frequency.magnitude", frequency.magnitude, points);
  requireLength("bounds.frequency.phase", frequency.phase, points);
  const std::size_t levels = bounds.levels.size();
  requireBands("bounds.frequency.magnitude_bands", frequency.magnitude_bands, levels, points);
  requireBands("bounds.frequency.phase_bands", frequency.phase_bands, levels, points);
  requireBands("bounds.frequency.relative_error", frequency.relative_error, levels, points);
  requireLength("bounds.step.nominal", bounds.step.nominal, bounds.step.time.size());
  requireBands("bounds.step.bands", bounds.step.bands, levels, bounds.step.time.size());
  for (const ComplexRegion& region : bounds.regions)
    requireLength("bounds.regions.imaginary", region.imaginary, region.real.size());
  if (bounds.weight)
    requireLength("bounds.weight.bound", bounds.weight->bound, bounds.weight->omega.size());
  if (bounds.prediction) requireCalibration(*bounds.prediction);
}

void requireConsistent(const Explanation& explanation) {
  for (std::size_t i = 0; i < explanation.causes.size(); ++i) {
    const Cause& cause = explanation.causes[i];
    if (cause.simulation)
      requireCurve("causes[" + std::to_string(i) + "].simulation.curve", cause.simulation->curve);
  }
  const auto& found = explanation.simulation;
  for (std::size_t i = 0; i < found.causes.size(); ++i)
    requireCurve("simulation.causes[" + std::to_string(i) + "].curve", found.causes[i].curve);
  for (const SimulatedWindow& window : found.pictures) {
    requireLengthUnlessEmpty("simulation.pictures.before", window.before, window.measured.size());
    requireLengthUnlessEmpty("simulation.pictures.after", window.after, window.measured.size());
  }
  if (explanation.own_simulation)
    for (const OwnRun& run : explanation.own_simulation->runs) {
      requireLength("own_simulation.runs.yours", run.yours, run.measured.size());
      requireLength("own_simulation.runs.extended", run.extended, run.measured.size());
    }
  for (const ExperimentPicture& picture : explanation.pictures) {
    const Index samples = picture.measured.size();
    requireLengthUnlessEmpty("pictures.input", picture.input, samples);
    requireLengthUnlessEmpty("pictures.simulated_before", picture.simulated_before, samples);
    requireLengthUnlessEmpty("pictures.simulated_after", picture.simulated_after, samples);
    requireLengthUnlessEmpty("pictures.deviation_before", picture.deviation_before, samples);
    requireLengthUnlessEmpty("pictures.deviation_after", picture.deviation_after, samples);
  }
}

}  // namespace uncertainty_identification
