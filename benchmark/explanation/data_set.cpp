#include "data_set.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "io/atomic_file.h"
#include "io/truth_yaml.h"
#include "reported_parameters.h"
#include "uncertainty_identification/io/configuration_yaml.h"
#include "uncertainty_identification/io/csv.h"

namespace uncertainty_identification::suite {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// All names that are equivalent to this one, including itself.
std::vector<std::string> equivalents(const std::string& name) {
  for (const auto& names : equivalenceClasses()) {
    if (contains(names, name)) return names;
  }
  return {name};
}

/// Whether the cause names a covariate that has no effect in the simulation.
bool namesDecoy(const Cause& cause) {
  return (cause.name == "plant_temp" && cause.variant != "temp") ||
         (cause.name == "exp_input2" && cause.variant != "d");
}

/// Whether the cause counts as finding this hidden effect.
bool accepts(const Cause& cause, const std::string& truth) {
  if (namesDecoy(cause)) return false;
  return cause.name == truth ||
         (contains(equivalents(truth), cause.name) && contains(cause.equivalent, truth));
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " + ") + name;
  return text.empty() ? "nothing" : text;
}

/// The configuration that explain() is given.
Configuration configurationOf(const Task& task, const test::HiddenEffect& hidden) {
  Configuration configuration = hidden.declared;
  if (task.orders_auto) configuration.nominal_model = NominalModelOptions();
  configuration.estimation.threads = task.threads;
  configuration.explanation.time_limit = 0;  // the answer must not depend on the machine
  if (!task.removed) return configuration;
  for (const std::string& name : hidden.names) {
    for (const std::string& each : equivalents(name))
      configuration.explanation.exclude.push_back(each);
  }
  return configuration;
}

/// The parameters of the causes that have a true value.
std::vector<RecoveredParameter> recovered(const std::vector<Cause>& causes,
                                          const std::map<std::string, double>& truth) {
  std::vector<RecoveredParameter> all;
  for (const Cause& cause : causes) {
    for (const CauseParameter& parameter : cause.parameters) {
      const auto value = valueOf(truth, cause.name, cause.variant, parameter.name);
      if (!value) continue;
      const double rounding = 1e-12 * std::abs(*value);  // a quantisation step is found exactly
      all.push_back({cause.name, parameter.name, *value, parameter.value, {}});
      if (std::isfinite(parameter.lower_90) && std::isfinite(parameter.upper_90))
        all.back().covered =
            parameter.lower_90 - rounding <= *value && *value <= parameter.upper_90 + rounding;
    }
  }
  return all;
}

/// The gain of the cause when it is measured on fresh experiments. There is none unless explain()
/// finds the same cause again.
std::optional<Gain> freshGain(const Configuration& configuration, const Outcome& outcome,
                              const std::vector<Experiment>& training,
                              const std::vector<Experiment>& fresh) {
  if (!outcome.exact() || outcome.causes.size() != 1) return std::nullopt;
  const Explanation again = explain(configuration, training, fresh);
  const bool same = again.causes.size() == 1 && again.causes[0].name == outcome.causes[0].name;
  return same ? again.causes[0].gain : std::nullopt;
}

}  // namespace

const std::vector<std::vector<std::string>>& equivalenceClasses() {
  static const std::vector<std::vector<std::string>> kClasses = {
      {"act_offset", "sens_bias"},
      {"plant_pole", "sens_lag", "act_delay"},
      {"sens_outliers", "noise_tails"}};
  return kClasses;
}

std::string Task::title() const {
  return part + " " + joined(hidden) + " run " + std::to_string(run);
}

// The 64-bit FNV-1a hash of the names, plus a multiple of a large odd number for each run.
std::uint64_t Task::seed() const {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char character : joined(hidden))
    hash = (hash ^ static_cast<unsigned char>(character)) * 0x100000001b3;
  return hash + static_cast<std::uint64_t>(run) * 0x9e3779b97f4a7c15;
}

double RecoveredParameter::relativeError() const { return std::abs(estimate / truth - 1); }

int Outcome::found() const {
  return static_cast<int>(
      std::count_if(hidden.names.begin(), hidden.names.end(), [this](const std::string& name) {
        return std::any_of(causes.begin(), causes.end(),
                           [&](const Cause& cause) { return accepts(cause, name); });
      }));
}

bool Outcome::exact() const {
  return failure.empty() && right() && causes.size() == hidden.names.size() && !raisesUnknown();
}

bool Outcome::namesStructure() const {
  return std::any_of(causes.begin(), causes.end(), [](const Cause& cause) {
    return cause.name.rfind("noise_", 0) != 0 && cause.name != "sens_outliers";
  });
}

std::string Outcome::line() const {
  std::vector<std::string> names;
  for (const Cause& cause : causes) {
    const bool tied = !cause.equivalent.empty();
    names.push_back(cause.name + (tied ? " (or " + joined(cause.equivalent) + ")" : ""));
  }
  char time[32];
  std::snprintf(time, sizeof time, "%.2f s", seconds);
  const std::string verdict_text = failure.empty() ? nameOf(verdict) : "error: " + failure;
  const std::string judged = exact() ? "exact" : right() ? "right" : "missed";
  return task.title() + ": " + joined(names) + " [" + verdict_text + "] " + judged + " " + time;
}

test::HiddenEffect hide(const Task& task) {
  return test::randomHiddenEffect(task.hidden, task.options, task.seed());
}

Outcome carryOut(const Task& task) {
  Outcome outcome;
  outcome.task = task;
  outcome.hidden = hide(task);
  const test::HiddenEffectData data = test::simulateHidden(outcome.hidden, task.options);
  const Configuration configuration = configurationOf(task, outcome.hidden);
  const auto begin = std::chrono::steady_clock::now();
  Estimate before;
  try {
    const Explanation explanation = explain(configuration, data.training, data.held_out);
    outcome.verdict = explanation.verdict;
    outcome.causes = explanation.causes;
    before = explanation.before;
  } catch (const std::exception& error) {
    outcome.failure = error.what();
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  outcome.parameters =
      recovered(outcome.causes, reportedParameters(outcome.hidden.truth, data.training));
  if (task.fresh > 0 && outcome.failure.empty()) {
    const std::vector<Experiment> fresh = test::simulateFresh(outcome.hidden, task.fresh);
    outcome.fresh_gain = freshGain(configuration, outcome, data.training, fresh);
    outcome.true_gain = trueGain(outcome.hidden, before, data.training, fresh);
  }
  return outcome;
}

void writeData(const Task& task, const std::string& folder) {
  const test::HiddenEffect hidden = hide(task);
  const test::HiddenEffectData data = test::simulateHidden(hidden, task.options);
  const std::filesystem::path path(folder);
  std::filesystem::create_directories(path);
  writeCsv(path / "training.csv", data.training);
  if (!data.held_out.empty()) writeCsv(path / "held_out.csv", data.held_out);
  writeFileAtomically(path / "configuration.yaml",
                      toJson(configurationOf(task, hidden)).dump(1) + "\n");
  writeFileAtomically(path / "truth.json", answerJson(hidden.truth, hidden.seed).dump(1) + "\n");
}

}  // namespace uncertainty_identification::suite
