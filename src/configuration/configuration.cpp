#include "uncertainty_identification/configuration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "configuration/require.h"
#include "uncertainty_identification/enum_names.h"

namespace uncertainty_identification {
namespace {

constexpr int kMaxCoefficients = 50;  // of one polynomial
constexpr int kMaxDelay = 100000;     // [samples]

template <class Value>
void requireRangeOrAutomatic(const std::string& key, const Value& value, const Value& low,
                             const Value& high) {
  if (value != kAutomatic) requireRange(key, value, low, high, "auto");
}

void requirePositive(const std::string& key, double value) {
  require(value > 0 && std::isfinite(value), key, value, "a finite number above 0");
}

void requireNotNegative(const std::string& key, double value) {
  require(value >= 0 && std::isfinite(value), key, value, "a finite number, 0 or above");
}

void validateSignal(const std::string& key, const SignalOptions& signal) {
  require(!signal.topic.empty(), key + ".topic", "an empty text", "the name of a topic");
  require(!signal.field.empty(), key + ".field", "an empty text",
          "the path of a numeric field, or auto");
  require(signal.scale != 0 && std::isfinite(signal.scale), key + ".scale", signal.scale,
          "a finite number other than 0, or deg");
  require(std::isfinite(signal.offset), key + ".offset", signal.offset, "a finite number");
}

void validateCovariates(const std::vector<SignalOptions>& covariates) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < covariates.size(); ++i) {
    const std::string key = "covariates[" + std::to_string(i) + "]";
    SignalOptions signal = covariates[i];
    if (!signal.column.empty() && signal.topic.empty()) signal.topic = signal.column;
    validateSignal(key, signal);
    require(!covariates[i].name.empty(), key + ".name", "an empty text", "a name");
    require(names.insert(covariates[i].name).second, key + ".name", covariates[i].name,
            "a name that no other covariate has");
  }
}

// The number n of free error parameters xi (eta = T xi), for bases whose n follows from the
// options.
int errorParameters(const ErrorModelOptions& options) {
  if (options.constraint == Constraint::explicit_matrix) return static_cast<int>(options.T.cols());
  return options.constraint == Constraint::zero_static_gain ? options.taps - 1 : options.taps;
}

void validateExplicitMatrix(const ErrorModelOptions& options) {
  const std::string shape =
      std::to_string(options.T.rows()) + " x " + std::to_string(options.T.cols());
  require(options.taps != kAutomatic, "error_model.taps", "auto",
          "a number, the rows of T, when constraint is explicit");
  require(options.T.rows() == options.taps && options.T.cols() >= 1 &&
              options.T.cols() <= options.T.rows(),
          "error_model.T", "a " + shape + " matrix",
          "taps = " + std::to_string(options.taps) + " rows and between 1 and taps columns");
  require(options.T.allFinite(), "error_model.T", "an entry that is not finite", "finite numbers");
}

// Options of a basis that varies parameters of Go; names are checked against the model later.
void validateVaryingParameters(const ErrorModelOptions& options) {
  const bool spread = options.basis == BasisKind::parameter_spread;
  if (!spread && options.basis != BasisKind::sensitivity) return;
  require(options.constraint == Constraint::zero_mean ||
              (!spread && options.constraint == Constraint::free),
          "error_model.constraint", nameOf(options.constraint),
          spread ? "zero_mean with basis parameter_spread: the parameters and the mean of their "
                   "deviations cannot be told apart"
                 : "zero_mean or free with basis sensitivity");
  std::set<std::string> names;
  for (const std::string& name : options.parameters)
    require(names.insert(name).second, "error_model.parameters", name, "each parameter once");
}

}  // namespace

Constraint defaultConstraint(BasisKind basis) {
  const bool varies = basis == BasisKind::sensitivity || basis == BasisKind::parameter_spread;
  return varies ? Constraint::zero_mean : Constraint::zero_static_gain;
}

ErrorModelOptions paperErrorModel() {
  ErrorModelOptions options;
  options.basis = BasisKind::fir;
  return options;
}

void NominalModelOptions::validate() const {
  require(fit == PlantFit::likelihood || structure == Structure::output_error ||
              structure == Structure::box_jenkins,
          "nominal_model.fit", "simulation",
          "likelihood, or structure output_error or box_jenkins");
  const std::string at = "nominal_model.";
  requireRange(at + "max_order", max_order, 1, 20);
  requireRange(at + "max_delay", max_delay, 0, kMaxDelay);
  requireRange(at + "nb", nb, 1, kMaxCoefficients);
  requireRange(at + "na", na, 0, kMaxCoefficients);
  requireRange(at + "nc", nc, 0, kMaxCoefficients);
  requireRange(at + "nd", nd, 0, kMaxCoefficients);
  requireRange(at + "delay", delay, 0, kMaxDelay);
  requireRange(at + "time_constants", time_constants, 0, kMaxCoefficients);
  requireRange(at + "resonances", resonances, 0, kMaxCoefficients / 2);
  requireRange(at + "zeros", zeros, 0, kMaxCoefficients);
  const NominalModelOptions unstated;
  const auto form = [](const NominalModelOptions& of) {
    return std::make_tuple(of.structure, of.nb, of.na, of.nc, of.nd, of.delay);
  };
  require(!orders_auto || form(*this) == form(unstated), at + "orders", "auto",
          "given (in C++: orders_auto = false) where the structure or an order is stated, which "
          "would not be used");
  if (structure == Structure::continuous) {
    const int poles = time_constants + 2 * resonances;
    require(zeros < poles, at + "zeros", zeros,
            "fewer than the " + std::to_string(poles) + " poles (time_constants + 2 resonances)");
  }
  if (structure == Structure::modal) {
    require(time_constants + resonances > 0, at + "time_constants", time_constants,
            "at least one pole (time_constants + resonances)");
    require(fixed.empty(), at + "fixed", std::to_string(fixed.size()) + " parameters",
            "nothing with structure: modal");
    require(zeros == 0, at + "zeros", zeros, "0 with structure: modal, which has residues");
    require(!dead_time, at + "dead_time", "true", "false with structure: modal");
    require(feedthrough || delay > 0, at + "delay", delay,
            "at least 1 (the hold's own sample), or feedthrough: true");
    const Eigen::Index own = 2 * time_constants + 4 * resonances + (feedthrough ? 1 : 0);
    const Eigen::Index rows = directions.rows();
    const bool fits = rows == directions.cols() && rows == center.size() && center.allFinite() &&
                      directions.allFinite() && (rows == 0 || rows == own);
    require(fits, at + "directions", std::to_string(rows) + " rows",
            "a finite square matrix, and a center, for the " + std::to_string(own) +
                " parameters of Go, or nothing");
  }
  for (const auto& [name, value] : fixed)
    require(std::isfinite(value), at + "fixed." + name, value, "a finite number");
}

void ErrorModelOptions::validate() const {
  const std::string at = "error_model.";
  requireRangeOrAutomatic(at + "taps", taps, 0, kMaxErrorParameters + 1);
  requireRangeOrAutomatic(at + "components", components, 1, 10);
  requireRange(at + "max_taps", max_taps, 1, kMaxErrorParameters + 1);
  requireRange(at + "max_components", max_components, 1, 10);
  require(std::abs(pole) < 1, at + "pole", pole, "above -1 and below 1");
  require(std::hypot(pole_real, pole_imag) < 1, at + "pole_real", pole_real,
          "pole_real and pole_imag inside the unit circle");
  require(basis != BasisKind::kautz || pole_imag != 0, at + "pole_imag", pole_imag,
          "a number other than 0 (a real pole: basis laguerre)");
  requireRange(at + "sensitivity_order", sensitivity_order, 1, 2);
  if (constraint == Constraint::explicit_matrix) validateExplicitMatrix(*this);
  if (taps != 0) validateVaryingParameters(*this);
  if (taps != kAutomatic && taps != 0) {
    const int free = errorParameters(*this);
    require(free >= 1 && free <= kMaxErrorParameters, at + "taps", taps,
            "a number that leaves between 1 and 10 free error parameters (zero_static_gain takes "
            "one away), or 0 for no error model");
  }
  const ErrorModelOptions unstated;
  const bool unused = constraint != unstated.constraint || !parameters.empty() || T.size() > 0 ||
                      (taps != unstated.taps && taps != kAutomatic && taps != 0);
  require(basis != BasisKind::automatic || !unused, at + "basis", "auto",
          "given (in C++: basis fir) where constraint, taps, T or parameters are stated, which "
          "would not be used");
}

void EstimationOptions::validate() const {
  const std::string at = "estimation.";
  requireRange(at + "max_iterations", max_iterations, 0, 1000000);
  requireNotNegative(at + "time_limit", time_limit);
  require(tolerance > 0 && tolerance < 1, at + "tolerance", tolerance, "above 0 and below 1");
  requireRange(at + "restarts", restarts, 0, 1000);
  requireRangeOrAutomatic(at + "threads", threads, 1, 1024);
  if (initial_precision != kAutomatic)
    requireNotNegative(at + "initial_precision", initial_precision);
  if (initial_variance != kAutomatic) requirePositive(at + "initial_variance", initial_variance);
  requireRange(at + "discard_samples", discard_samples, 0, 1000000000);
  requireRangeOrAutomatic(at + "thinning", thinning, 1, 1000000);
}

void InitialOptions::validate() const {
  const std::string at = "initial.";
  require(theta.allFinite(), at + "theta", "an entry that is not finite", "finite numbers");
  if (mixture.components() > 0 || !mixture.means.empty() || !mixture.covariances.empty()) {
    mixture.validate("initial");
  }
  if (noise_variance) requirePositive(at + "noise_variance", *noise_variance);
}

void ResamplingOptions::validate() const {
  requireNotNegative("resampling.max_age", max_age);
  requireNotNegative("resampling.max_jitter", max_jitter);
}

bool TimeOptions::counts() const {
  return unit == TimeUnit::index ||
         (unit == TimeUnit::automatic && column.empty() && sample_time > 0);
}

void TimeOptions::validate() const {
  requireNotNegative("time.sample_time", sample_time);
  if (unit == TimeUnit::index) requirePositive("time.sample_time", sample_time);
  require(counts() || sample_time == 0, "time.sample_time", sample_time,
          "0 beside a column of stamps or a unit of them; time: {sample_time: S} alone counts the "
          "rows, unit: index counts by the column, and sample_time outside of `time` resamples");
}

void ExperimentOptions::validate() const {
  const bool listens = mode == ExperimentMode::topic || mode == ExperimentMode::message;
  require(!listens || !topic.empty(), "experiment.topic", "an empty text", "the name of a topic");
  requireNotNegative("experiment.duration", duration);
  requireNotNegative("experiment.gap", gap);
  if (mode == ExperimentMode::duration) requirePositive("experiment.duration", duration);
  if (mode == ExperimentMode::gap) requirePositive("experiment.gap", gap);
}

void BoundsOptions::validate() const {
  for (double level : levels)
    require(level > 0 && level < 1, "bounds.levels", level, "levels above 0 and below 1");
  require(!levels.empty() && std::is_sorted(levels.begin(), levels.end()), "bounds.levels",
          levels.empty() ? "none" : "levels out of order", "at least one level, ascending");
  if (frequencies != 0) requireRange("bounds.frequencies", frequencies, 10, 100000, "0");
  for (Eigen::Index k = 0; k < grid.size(); ++k) {
    require(grid[k] > (k == 0 ? 0.0 : grid[k - 1]) && std::isfinite(grid[k]), "bounds.grid",
            grid[k], "ascending frequencies above 0 [rad/s]");
  }
  requireRangeOrAutomatic("bounds.steps", steps, 2, 100000);
  const double tail = (1 - std::max(levels.back(), weight_level)) / 2;
  requireRange("bounds.samples", samples, static_cast<int>(std::ceil(2 / tail)), 1000000,
               "fewer for lower levels");
  requireRangeOrAutomatic("bounds.weight_order", weight_order, 0, 8);
  require(weight_level > 0 && weight_level < 1, "bounds.weight_level", weight_level,
          "a level above 0 and below 1");
  if (folds != 0) requireRange("bounds.folds", folds, 2, 1000, "0");
}

void ExplanationOptions::validate() const {
  requireRange("explanation.max_causes", max_causes, 0, 10);
  requirePositive("explanation.acceptance", acceptance);
  require(validation_share > 0 && validation_share <= 0.9, "explanation.validation_share",
          validation_share, "above 0, at most 0.9");
  requireNotNegative("explanation.time_limit", time_limit);
  requireRange("explanation.after_experiments", after_experiments, 0,
               std::numeric_limits<int>::max());
}

void FullIdentificationOptions::validate() const {
  require(share >= 0 && share <= 1, "full_identification.share", share, "0 to 1");
  requireNotNegative("full_identification.quiet", quiet);
}

void LimitOptions::validate() const {
  constexpr int kMost = std::numeric_limits<int>::max();
  requireRange("limits.max_experiments", max_experiments, 1, kMost);
  requireRange("limits.max_samples", max_samples, 1, kMost);
  requireRange("limits.min_samples", min_samples, 1, max_samples);
  require(max_missing >= 0 && max_missing < 1, "limits.max_missing", max_missing,
          "at least 0 and below 1");
  require(max_stray >= 0 && max_stray <= 0.05, "limits.max_stray", max_stray, "0 to 0.05");
  requireRange("limits.max_request_size", max_request_size, 1, 1024);
  requireRange("limits.max_bag_size", max_bag_size, 1, 1 << 20);
  requireRange("limits.max_saved_files", max_saved_files, 0, kMost);
  requirePositive("limits.max_request_time", max_request_time);
}

void Configuration::validate() const {
  require(sample_time >= 0 && std::isfinite(sample_time), "sample_time", sample_time,
          "a finite number above 0, or auto");
  nominal_model.validate();
  error_model.validate();
  estimation.validate();
  initial.validate();
  explanation.validate();
  if (simulation) simulation->validate();
  resampling.validate();
  full_identification.validate();
  bounds.validate();
  require(!report_each_result || !report_directory.empty(), "report_each_result", "true",
          "false, as long as report_directory is empty");
  validateSignal("input", input);
  validateSignal("output", output);
  validateCovariates(covariates);
  time.validate();
  experiment.validate();
  requireRange("live_page.port", live_page_port, 0, 65535);
  limits.validate();
}

}  // namespace uncertainty_identification
