#include "detection/fault_detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "configuration/require.h"
#include "detection/spread_linearity.h"
#include "math/polynomial.h"
#include "math/symmetric_eigen.h"
#include "model/sensitivity.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLargest = 1e100;  // of what is squared and added up over a window
constexpr double kStep = 1e-3;      // step of difference quotients, in standard deviations

EstimationOptions nuisanceOptions(const Estimate& estimate, const FaultDetectionOptions& options) {
  EstimationOptions used = estimate.configuration.estimation;
  if (options.initial_state) used.initial_state = *options.initial_state;
  if (options.discard_samples != kAutomatic) used.discard_samples = options.discard_samples;
  return used;
}

/// The basis of the estimate's error model, with T as in the result.
RationalBasis basisOf(const Estimate& estimate) {
  ErrorModelOptions options = estimate.error_model.options;
  if (options.taps <= 0 || estimate.error_model.mixture.dimension() == 0) {
    options = ErrorModelOptions();
    options.taps = 0;
    return RationalBasis(ErrorBasis(options));
  }
  if (variesParameters(estimate.error_model.options.basis)) {
    throw DataError(
        "error_model.basis: fault detection takes fir, laguerre or kautz; found one that varies "
        "the nominal model's parameters");
  }
  options.constraint = Constraint::explicit_matrix;
  options.T = estimate.error_model.T;
  return RationalBasis(ErrorBasis(options));
}

/// The nominal model that the configuration describes if, at theta, it has the polynomials of the
/// result; otherwise null.
std::shared_ptr<const NominalModel> nominalModelOf(const Estimate& estimate,
                                                   const VectorXd& theta) {
  const NominalModelEstimate& go = estimate.nominal_model;
  auto model = makeNominalModel(estimate.configuration.nominal_model, go.sample_time);
  if (model->parameterCount() != theta.size()) return nullptr;
  const VectorXd found = model->polynomials(theta).stacked();
  const VectorXd wanted = Polynomials{go.delay, go.b, go.a, go.c, go.d}.stacked();
  return found.size() == wanted.size() && found.isApprox(wanted, 1e-6) ? model : nullptr;
}

/// The estimate's model with other parameters of the nominal model.
StreamModel modelAt(const Estimate& estimate, const NominalModel& nominal, const VectorXd& theta) {
  if (variesParameters(estimate.error_model.options.basis)) {
    ErrorModelOptions options = estimate.error_model.options;
    options.basis = BasisKind::sensitivity;  // a stream is linear in xi: the spread to first order
    return streamModel(nominal, options, theta);
  }
  return streamModel(nominal.polynomials(theta), basisOf(estimate));
}

VectorXd valuesOf(const std::vector<ParameterEstimate>& parameters) {
  VectorXd values(static_cast<Index>(parameters.size()));
  for (Index k = 0; k < values.size(); ++k)
    values[k] = parameters[static_cast<std::size_t>(k)].value;
  return values;
}

/// Every direction of the initial state is a coordinate of the filter, whose covariance grows with
/// their square.
StreamModel manageable(StreamModel model) {
  constexpr Index kMostDirections = 2000;
  if (model.free_directions <= kMostDirections) return model;
  throw DataError("nominal_model.delay: faults are detected for models with up to " +
                  std::to_string(kMostDirections) + " samples of delay and coefficients, found " +
                  std::to_string(model.free_directions));
}

StreamModel modelOf(const Estimate& estimate) {
  const NominalModelEstimate& go = estimate.nominal_model;
  if (!estimate.usable()) throw DataError("the model is not usable: " + estimate.message);
  if (!isStable(go.a)) throw DataError("nominal_model.a: the model is not stable");
  const BasisKind basis = estimate.error_model.options.basis;
  if (!variesParameters(basis))
    return streamModel({go.delay, go.b, go.a, go.c, go.d}, basisOf(estimate));
  const VectorXd theta = valuesOf(go.parameters);
  const auto nominal = nominalModelOf(estimate, theta);
  if (nominal == nullptr) {
    throw ConfigurationError(
        "error_model.basis: faults can be detected with fir, laguerre and kautz, and with "
        "sensitivity and parameter_spread if the configuration states the nominal model; identify "
        "with one of them");
  }
  return modelAt(estimate, *nominal, theta);
}

/// The score of a sample that the model excludes.
Score impossible(double noise_variance) {
  Score score;
  score.value = kLargest;
  score.deviation = std::sqrt(noise_variance);
  return score;
}

/// Degrees of freedom of a chi-squared distribution with this mean and standard error.
double degreesOf(const ParameterEstimate& variance) {
  const double relative = variance.standard_error / variance.value;
  constexpr double kFewest = 1;  // also where the standard error is beyond all reason
  return relative > 0 ? std::max(2 / (relative * relative), kFewest)
                      : std::numeric_limits<double>::infinity();
}

/// The predictive distribution of the xi of a new experiment, given a mixture that was estimated
/// from `experiments` experiments. A component that m of them belong to predicts a Student
/// distribution, which is replaced by a Gaussian of the same covariance.
Mixture predictive(Mixture mixture, int experiments) {
  for (std::size_t i = 0; i < mixture.weights.size(); ++i) {
    const double m = mixture.weights[i] * experiments, n = mixture.dimension();
    mixture.covariances[i] *= (m + 1) / std::max(m - n - 2, 1.0);
  }
  return mixture;
}

}  // namespace

void FaultDetectionOptions::validate() const {
  requireRange("window", window, 10, 100000);
  requireRange("false_alarm_rate", false_alarm_rate, 1e-9, 0.5);
  if (discard_samples != kAutomatic)
    requireRange("discard_samples", discard_samples, 0, 1000000, "auto");
}

FaultDetector::FaultDetector(const Estimate& estimate, const FaultDetectionOptions& options)
    : options_(options),
      estimation_(nuisanceOptions(estimate, options)),
      sample_time_(estimate.nominal_model.sample_time),
      offset_u_(estimate.offset_u),
      offset_y_(estimate.offset_y),
      noise_variance_(estimate.noise_variance.value),
      threshold_(-std::log10(options.false_alarm_rate)),
      noise_degrees_(std::numeric_limits<double>::infinity()),
      mixture_(estimate.error_model.mixture),
      models_{manageable(modelOf(estimate))} {
  options.validate();
  const auto regressors = static_cast<int>(models_.front().regressors.size());
  if (regressors > 0 && regressors != mixture_.dimension()) {
    throw DataError("error_model.varied_parameters: found " + std::to_string(regressors) +
                    " parameters or products of them, and a mixture of dimension " +
                    std::to_string(mixture_.dimension()));
  }
  if (!(noise_variance_ > 0))
    throw DataError("noise_variance: found " + std::to_string(noise_variance_) +
                    "; it must be positive to detect faults");
  if (models_.front().regressors.empty()) mixture_ = Mixture();
  warnAboutSpread(estimate);
  if (options.parameter_uncertainty) {
    noise_degrees_ = degreesOf(estimate.noise_variance);
    if (estimate.experiment_count > 0) mixture_ = predictive(mixture_, estimate.experiment_count);
    prepareParameters(estimate);
  }
  reset();
}

void FaultDetector::warnAboutSpread(const Estimate& estimate) {
  constexpr double kLinear = 0.1;
  if (estimate.error_model.options.basis != BasisKind::parameter_spread || mixture_.dimension() < 1)
    return;
  const double share = shareBeyondFirstOrder(
      estimate, nominalModelOf(estimate, valuesOf(estimate.nominal_model.parameters)));
  if (share < kLinear) return;
  warnings_.push_back(
      "fault detection follows the differences between the plants to first order, which lacks " +
      std::to_string(std::lround(100 * share)) +
      " % of them: false alarms will be far more frequent than configured; identify with "
      "error_model: {basis: fir} for this purpose, and check the alarms on records without a "
      "fault");
}

void FaultDetector::prepareParameters(const Estimate& estimate) {
  const NominalModelEstimate& go = estimate.nominal_model;
  const VectorXd theta = valuesOf(go.parameters);
  const auto model = nominalModelOf(estimate, theta);
  if (go.covariance.rows() != theta.size() || !go.covariance.allFinite() || model == nullptr) {
    warnings_.push_back(
        "the result holds no covariance of the nominal model's parameters: their errors are "
        "neglected, and false alarms will be more frequent than configured");
    return;
  }
  const SymmetricEigen eigen(go.covariance);
  for (Index k = 0; k < theta.size(); ++k) {
    const double deviation = std::sqrt(std::max(eigen.eigenvalues()[k], 0.0));
    if (deviation == 0) continue;
    const VectorXd step = kStep * deviation * eigen.eigenvectors().col(k);
    models_.push_back(modelAt(estimate, *model, theta + step));
    models_.push_back(modelAt(estimate, *model, theta - step));
  }
}

void FaultDetector::reset() {
  streams_.clear();
  for (const StreamModel& model : models_)
    streams_.emplace_back(model, estimation_, offset_u_, offset_y_);
  const auto parameters = static_cast<Index>(models_.size() - 1) / 2;
  const Index n = streams_.front().regressors();
  observation_ = {0, VectorXd::Zero(n), VectorXd::Zero(parameters), MatrixXd::Zero(parameters, n),
                  VectorXd::Zero(streams_.front().columns())};
  learned_.emplace(mixture_, parameters, streams_.front().columns(), noise_variance_);
  tentative_ = learned_;
  scores_ = VectorXd::Zero(options_.window);
  effects_ = MatrixXd::Zero(options_.window, 2);
  signature_ = 0;
  filled_ = 0;
  samples_ = window_first_ = 0;
}

Score FaultDetector::score(double u, double y) {
  const Index n = observation_.regressors.size(), columns = observation_.columns.size();
  const VectorXd& nominal = streams_.front().step(u, y);
  observation_.residual = nominal[0];
  signature_ = nominal[1];
  observation_.regressors = nominal.segment(2, n);
  observation_.columns = nominal.tail(columns);
  for (std::size_t k = 1; k < streams_.size(); k += 2) {
    const VectorXd change =
        (streams_[k].step(u, y) - streams_[k + 1].step(u, y)).head(n + 2) / (2 * kStep);
    const auto j = static_cast<Index>(k / 2);
    observation_.residual_derivative[j] = change[0];
    observation_.regressor_derivatives.row(j) = change.tail(n).transpose();
  }
  return streams_.front().measured() ? tentative_->update(observation_) : Score();
}

std::optional<FaultWindow> FaultDetector::add(double u, double y) {
  if (!std::isfinite(u)) {
    throw DataError(
        "sample " + std::to_string(samples_) +
        ": the input is not finite; faults can be detected only if all inputs are known");
  }
  const double before = signature_;
  Score found = score(u, y);
  ++samples_;
  if (!streams_.front().measured() || found.diffuse) return std::nullopt;
  // A filter that diverges after samples that it followed has no xi that explains the plant.
  const bool followed = filled_ > 0 || samples_ > options_.window;
  if (followed && !(std::isfinite(found.value) && std::isfinite(found.deviation)))
    found = impossible(noise_variance_);
  const Eigen::RowVector2d effects(signature_ / found.deviation, before / found.deviation);
  if (std::isnan(found.value) || !(effects.array().abs() < kLargest).all()) {
    throw DataError(
        "the model's prediction is not a number within range: its coefficients or their errors are "
        "too large; identify the model again");
  }
  if (filled_ == 0) window_first_ = samples_ - 1;
  scores_[filled_] = std::min(std::max(found.value, -kLargest), kLargest);
  effects_.row(filled_) = effects;
  if (++filled_ < options_.window) return std::nullopt;
  return decide();
}

FaultWindow FaultDetector::decide() {
  FaultWindow window;
  window.first = window_first_;
  window.last = samples_ - 1;
  window.probabilities = testWindow(scores_, effects_, noise_degrees_);
  window.statistic = -std::log10(window.probabilities.combined);
  window.threshold = threshold_;
  window.fault = window.statistic > threshold_;
  if (window.fault) {
    tentative_ = learned_;
  } else {
    learned_ = tentative_;
  }
  window.component_probabilities = learned_->probabilities();
  window.error_mean = learned_->errorMean();
  filled_ = 0;
  return window;
}

}  // namespace uncertainty_identification
