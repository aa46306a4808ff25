#include "explanation/cause_free_model.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "data/text.h"
#include "explanation/named_causes.h"
#include "explanation/prediction_checks.h"
#include "explanation/residual_checks.h"
#include "explanation/simulation_answer.h"
#include "explanation/verdict.h"
#include "explanation/warnings.h"
#include "identification/steps.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

constexpr double kShare = 1;  ///< of explanation.time_limit, in addition to it

bool leavesModelOpen(const Configuration& asked) {
  return asked.nominal_model.orders_auto && asked.effects.empty() &&
         asked.error_model.basis == BasisKind::automatic;
}

/// Whether tests fail that neither what the samples show nor a controller may account for.
bool isOpen(const Explanation& explanation) {
  if (explanation.verdict == Verdict::none || explanation.verdict == Verdict::explained)
    return false;
  const std::vector<Check>& checks = explanation.checks_after;
  return std::none_of(explanation.causes.begin(), explanation.causes.end(), isOfSamples) &&
         std::all_of(checks.begin(), checks.end(),
                     [](const Check& check) { return check.passed || check.name != kDirection; });
}

/// Whether the tests of its predictions pass, at the level of explain's own checks, and held-out
/// experiments are not simulated far worse: nothing speaks against a linear plant, although its
/// bounds may not be trusted for want of data.
bool agrees(const Estimate& estimate) {
  const std::vector<FailedTest> failed = failedTests(estimate.residual_tests);
  const bool passes = std::none_of(failed.begin(), failed.end(), [](const FailedTest& test) {
    return test.p_value < kCheckThreshold;
  });
  const double held_out = estimate.validation.simulation_fit_percent_pooled;
  const bool loses = !estimate.validation.experiments.empty() &&
                     isFarWorse(held_out, estimate.simulation_fit_percent.value_or(held_out));
  return estimate.usable() && estimate.residual_tests.samples > 0 && passes && !loses;
}

/// Whether the plant alone explains most of the output.
bool simulatesWell(const Estimate& estimate) {
  constexpr double kUseful = 50;  // [%] fit
  return estimate.simulation_fit_percent.value_or(0) >= kUseful &&
         (estimate.validation.experiments.empty() ||
          estimate.validation.simulation_fit_percent_pooled >= kUseful);
}

Check checkOf(const std::string& name, double p_value) {
  Check check;
  check.name = name;
  check.statistic = std::nan("");
  check.p_value = p_value;
  return check;
}

std::vector<Check> checksOf(const ResidualTests& tests) {
  return {checkOf("whiteness of predictions", tests.whiteness_p_value),
          checkOf("dependence on the input of predictions", tests.independence_p_value),
          checkOf("linearity of predictions", tests.linearity_p_value)};
}

std::vector<Experiment> heldOutOf(const Split& data) {
  return data.fitted_to ? std::vector<Experiment>() : data.held;
}

std::string messageOf(const Estimate& estimate) {
  std::string text =
      "the model that identify chooses by default agrees with the data: nothing in its residuals "
      "speaks against it.";
  if (!estimate.variation.empty()) text += " " + estimate.variation;
  const bool was_held_out = !estimate.validation.experiments.empty();
  const std::optional<double> fit = was_held_out ? estimate.validation.simulation_fit_percent_pooled
                                                 : estimate.simulation_fit_percent;
  if (fit)
    text += std::string(" Its simulation fits ") + (was_held_out ? "held-out data" : "the data") +
            " by " + rounded(*fit) + " %";
  return text;
}

/// Without a cause, the linear plant describes the data as well.
void withdrawCauses(Explanation* explanation) {
  if (explanation->causes.empty()) return;
  explanation->warnings.push_back(namesOf(explanation->causes) +
                                  ": not named, because the tests pass without it where the model "
                                  "is identified with the error model that identify chooses");
  explanation->causes.clear();
  forgetModelWithCauses(explanation);
  conclude(explanation, true);
}

/// What was said of the model of the search, but for what is so whatever the model is.
void forgetSearch(Explanation* explanation) {
  std::vector<std::string>& warnings = explanation->warnings;
  const std::string difference = explanation->simulation.difference;
  warnings.erase(std::remove_if(warnings.begin(), warnings.end(),
                                [&](const std::string& warning) {
                                  return warning != kNothingHeldOut && warning != difference;
                                }),
                 warnings.end());
  explanation->pictures.clear();
  explanation->residual_before = explanation->residual_after = {};
}

void take(const Estimate& estimate, const Split& data, Explanation* explanation) {
  forgetSearch(explanation);
  withdrawCauses(explanation);
  explanation->warnings.insert(explanation->warnings.end(), estimate.warnings.begin(),
                               estimate.warnings.end());
  explanation->verdict = Verdict::none;
  explanation->message = messageOf(estimate);
  explanation->before = explanation->after = estimate;
  explanation->checks_before = explanation->checks_after = checksOf(estimate.residual_tests);
  if (!data.fitted_to)
    explanation->held_out_fit = estimate.validation.simulation_fit_percent_pooled;
  explanation->termination = estimate.termination;
}

}  // namespace

void compareWithCauseFreeModel(const Configuration& asked, const Split& data,
                               SearchProgress& progress, Explanation* explanation) {
  if (!leavesModelOpen(asked) || !isOpen(*explanation)) return;
  const double until = progress.seconds() + kShare * asked.explanation.time_limit;
  const auto go = [&](const Progress& at) {
    return progress.report("identifying with another error model", 0.95, at.log_likelihood) &&
           (asked.explanation.time_limit <= 0 || progress.seconds() < until);
  };
  try {
    const Estimate estimate = Identifier(asked).identify(data.train, heldOutOf(data), go);
    const bool is_curve_clear = !leadingCurves(explanation->simulation).empty();
    if (!agrees(estimate) || (is_curve_clear && !estimate.trust.trusted)) return;
    if (simulatesWell(estimate))
      take(estimate, data, explanation);
    else
      withdrawCauses(explanation);
  } catch (const DataError& error) {
    explanation->warnings.push_back(
        std::string("the model that identify chooses by default could not be compared: ") +
        error.what());
  }
}

}  // namespace uncertainty_identification
