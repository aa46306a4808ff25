#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "data/experiment_checks.h"
#include "data/text.h"
#include "data/wrapped_signal.h"

namespace uncertainty_identification {
namespace {

/// Collects the findings about one experiment.
class Findings {
 public:
  explicit Findings(const std::string& id) : id_(id) {}

  void reject(const std::string& what, bool only_alone = false) {
    found_.push_back({id_, true, named(id_) + ": " + what, only_alone});
  }
  void warn(const std::string& what) {
    found_.push_back({id_, false, named(id_) + ": " + what, false});
  }
  bool empty() const { return found_.empty(); }
  std::vector<Finding> take() { return std::move(found_); }

 private:
  std::string id_;
  std::vector<Finding> found_;
};

std::string place(const Experiment& experiment, Eigen::Index k) {
  const double time = experiment.start_time + static_cast<double>(k) * experiment.sample_time;
  return "sample " + std::to_string(k) + " (" + text(time) + " s)";
}

void checkLength(const std::string& name, std::size_t found, const Experiment& experiment,
                 Findings& findings) {
  if (found == static_cast<std::size_t>(experiment.u.size())) return;
  findings.reject("it has " + std::to_string(experiment.u.size()) + " samples of the input but " +
                  std::to_string(found) + " of " + name +
                  "; give one for each sample of the input");
}

void checkLengths(const Experiment& experiment, Findings& findings) {
  checkLength("the output", static_cast<std::size_t>(experiment.y.size()), experiment, findings);
  if (!experiment.valid.empty())
    checkLength("valid", experiment.valid.size(), experiment, findings);
  for (const auto& [name, values] : experiment.signals) {
    checkLength("covariate '" + name + "'", static_cast<std::size_t>(values.size()), experiment,
                findings);
  }
  const auto offsets = static_cast<std::size_t>(experiment.stamp_offset.size());
  if (offsets > 0) checkLength("stamp_offset", offsets, experiment, findings);
}

/// Index of the first non-finite value.
std::optional<Eigen::Index> firstNonFinite(const Eigen::VectorXd& values) {
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (!std::isfinite(values(k))) return k;
  }
  return std::nullopt;
}

void checkFinite(const Experiment& experiment, Findings& findings) {
  if (const auto k = firstNonFinite(experiment.u)) {
    const auto bad = experiment.u.size() - experiment.u.array().isFinite().count();
    findings.reject("the input is " + text(experiment.u(*k)) + " at " + place(experiment, *k) +
                    ", and NaN or infinite in " + std::to_string(bad) + " of " +
                    std::to_string(experiment.u.size()) +
                    " samples; record a finite input throughout");
  }
  for (int k = 0; k < experiment.samples(); ++k) {
    if (!experiment.isValid(k) || std::isfinite(experiment.y(k))) continue;
    findings.reject("the output is " + text(experiment.y(k)) + " at " + place(experiment, k) +
                    "; record finite values, or mark the sample as missing (valid 0, an empty cell "
                    "in a CSV file)");
    return;
  }
}

void checkCovariates(const Experiment& experiment, const std::vector<std::string>& required,
                     Findings& findings) {
  const auto isRequired = [&](const std::string& name) {
    return std::find(required.begin(), required.end(), name) != required.end();
  };
  for (const std::string& name : required) {
    if (experiment.scalars.count(name) > 0 || experiment.signals.count(name) > 0) continue;
    findings.reject("covariate '" + name +
                    "' is missing; record it, or remove it from the configuration");
  }
  const auto report = [&](const std::string& name, const std::string& what) {
    const std::string message = "covariate '" + name + "' is " + what + "; record finite values";
    isRequired(name) ? findings.reject(message) : findings.warn(message);
  };
  for (const auto& [name, value] : experiment.scalars) {
    if (!std::isfinite(value)) report(name, text(value));
  }
  for (const auto& [name, values] : experiment.signals) {
    if (const auto k = firstNonFinite(values))
      report(name, text(values(*k)) + " at " + place(experiment, *k));
  }
}

void checkCounts(const Experiment& experiment, const LimitOptions& limits, Findings& findings) {
  const int samples = experiment.samples(), measured = experiment.validSamples();
  if (measured == 0) {
    findings.reject(
        "none of its " + std::to_string(samples) +
        " outputs is a number: they are NaN, infinite, empty or were not received; check "
        "the sensor, and that the right column or field is read");
    return;
  }
  if (measured < limits.min_samples) {
    findings.reject("it has " + std::to_string(measured) +
                    " measured samples, fewer than limits.min_samples " +
                    std::to_string(limits.min_samples) + "; record a longer experiment");
  }
  const double missing = 1 - static_cast<double>(measured) / samples;
  if (missing > limits.max_missing) {
    findings.reject(
        std::to_string(samples - measured) + " of " + std::to_string(samples) +
        " output samples are missing, a share of " + rounded(missing) +
        " above limits.max_missing " + text(limits.max_missing) +
        "; record the output without gaps, or raise resampling.max_age if the sensor is slow");
  }
}

void checkExcitation(const Experiment& experiment, Findings& findings) {
  const Eigen::VectorXd& u = experiment.u;
  if ((u.array() != u(0)).any()) return;
  findings.reject(
      "the input is constant (" + text(u(0)) +
          "), so that the plant is not excited; apply an input that changes, e.g. a random "
          "binary sequence; if it was switched on when the record began, begin the record "
          "before, at rest",
      u(0) != 0 && std::isfinite(u(0)));
}

void checkResponse(const Experiment& experiment, Findings& findings) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (int k = 0; k < experiment.samples(); ++k) {
    if (!experiment.isValid(k)) continue;
    lowest = std::min(lowest, experiment.y(k));
    highest = std::max(highest, experiment.y(k));
  }
  if (lowest != highest) return;
  findings.reject(
      "the output is constant (" + text(lowest) +
      "); check that the sensor is connected and that the right field of its message is read");
}

void checkWraps(const Experiment& experiment, Findings& findings) {
  if (const int wraps = wrapsOf(experiment))
    findings.warn("the output jumps from one end of its range to the other " +
                  std::to_string(wraps) +
                  " times and goes on in the same direction, as an angle does that starts again at "
                  "0 after 360 degrees: no model fits these jumps; record the angle unwrapped");
}

}  // namespace

std::vector<Finding> checkExperiment(const Experiment& experiment, const LimitOptions& limits,
                                     const std::vector<std::string>& required_covariates) {
  Findings findings(experiment.id);
  if (!(experiment.sample_time > 0) || !std::isfinite(experiment.sample_time)) {
    findings.reject("its sample time is " + text(experiment.sample_time) +
                    " s; it must be positive");
  }
  checkLengths(experiment, findings);
  if (experiment.samples() < 2) {
    findings.reject(experiment.samples() == 0
                        ? "it has no samples; record input and output during the experiment"
                        : "it has one sample only; record a longer experiment");
  }
  if (!findings.empty()) return findings.take();
  checkFinite(experiment, findings);
  checkCovariates(experiment, required_covariates, findings);
  checkCounts(experiment, limits, findings);
  checkExcitation(experiment, findings);
  checkResponse(experiment, findings);
  checkWraps(experiment, findings);
  return findings.take();
}

std::string defectOf(const Experiment& experiment, const LimitOptions& limits) {
  std::string defect;
  for (const Finding& finding : checkExperiment(experiment, limits, {}))
    if (finding.rejects && !finding.only_alone)
      defect += (defect.empty() ? "" : "; ") + finding.message;
  return defect;
}

}  // namespace uncertainty_identification
