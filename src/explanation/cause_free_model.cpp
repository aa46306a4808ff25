#include "explanation/cause_free_model.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "data/text.h"
#include "estimation/excerpt.h"
#include "explanation/confirmation.h"
#include "explanation/limits_of_time.h"
#include "explanation/measure.h"
#include "explanation/named_causes.h"
#include "explanation/open_answers.h"
#include "explanation/poor_simulation.h"
#include "explanation/prediction_checks.h"
#include "explanation/residual_checks.h"
#include "explanation/simulation_answer.h"
#include "explanation/undamped_poles.h"
#include "explanation/verdict.h"
#include "explanation/warnings.h"
#include "identification/steps.h"
#include "inspection/closed_loop.h"
#include "uncertainty_identification/effects/catalogue.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

/// Of explanation.time_limit, in addition to it; where nothing is wrong, only a figure is lacking.
constexpr double kShare = 0.5, kShareOfNone = 0.3;

std::vector<Experiment> heldOutOf(const Split& data) {
  return data.fitted_to ? std::vector<Experiment>() : data.held;
}

/// Whether the p-values of its tests are above `level`, and held-out experiments are not simulated
/// far worse: nothing speaks against a linear plant, although its bounds may not be trusted for
/// want of data.
bool agrees(const Estimate& estimate, double level) {
  const std::vector<FailedTest> failed = failedTests(estimate.residual_tests);
  const bool passes = std::none_of(failed.begin(), failed.end(), [level](const FailedTest& test) {
    return test.p_value < level;
  });
  const double held_out = estimate.validation.simulation_fit_percent_pooled;
  const bool loses = !estimate.validation.experiments.empty() &&
                     isFarWorse(held_out, estimate.simulation_fit_percent.value_or(held_out));
  return estimate.usable() && estimate.residual_tests.samples > 0 && passes && !loses;
}

/// [%] of held-out experiments or, where there are none, of those fitted to.
std::optional<double> simulationFitOf(const Estimate& estimate) {
  if (estimate.validation.experiments.empty()) return estimate.simulation_fit_percent;
  return estimate.validation.simulation_fit_percent_pooled;
}

/// The same about the common mean of all outputs, as the fits of causes are, also where every
/// experiment has an offset of its own.
std::optional<double> fitAboutCommonMean(const Estimate& estimate, const Split& data) {
  const Validation& validation = estimate.validation;
  if (validation.experiments.empty()) {
    const bool is_about_own = estimate.configuration.estimation.offsets == Offsets::per_experiment;
    const double levels = is_about_own ? spreadOfLevels(data.train) : 1;
    return estimate.simulation_fit_percent
               ? std::optional<double>(100 - (100 - *estimate.simulation_fit_percent) / levels)
               : std::nullopt;
  }
  double error = 0, sum = 0, squares = 0, count = 0;
  for (const Experiment& experiment : data.held) {
    const auto& ids = validation.experiments;
    const auto id = std::find(ids.begin(), ids.end(), experiment.id);
    if (id == ids.end()) continue;
    double of_sum = 0, of_squares = 0, of_count = 0;
    for (Eigen::Index k = 0; k < experiment.y.size(); ++k) {
      const double y = experiment.y[k];
      if (!std::isfinite(y)) continue;
      of_sum += y;
      of_squares += y * y;
      of_count += 1;
    }
    const double share =
        1 - validation.simulation_fit_percent[static_cast<std::size_t>(id - ids.begin())] / 100;
    error += share * share * (of_squares - of_sum * of_sum / std::max(of_count, 1.0));
    sum += of_sum;
    squares += of_squares;
    count += of_count;
  }
  return 100 * (1 - std::sqrt(error / std::max(squares - sum * sum / count, 1e-300)));
}

double squaredError(double fit) { return (100 - fit) * (100 - fit); }

/// Whether a cause simulates held-out data clearly better than the model without it. What makes
/// tests fail that passed is no cause all the same, a curve of no simple shape may stand for
/// levels that differ, and what differs between experiments is in the model without it as well.
bool isConfirmed(const Cause& cause, const Estimate& without, std::optional<double> fit,
                 bool passed_before) {
  constexpr double kClearly = 1.2;  // of the squared error
  if (passed_before || !fit || !cause.gain || hasTrait(cause.name, Trait::by_experiment))
    return false;
  const bool has_shape = !cause.simulation || cause.simulation->what.shape != "curve";
  return (has_shape || !without.trust.trusted) &&
         squaredError(*fit) > kClearly * squaredError(cause.gain->nrmse_fit_percent.after);
}

/// Whether the causes make the same data far more likely than the model without them, which may
/// differ from experiment to experiment in other ways: those held out as well, or, where there are
/// none, by far more. A weak cause shows so although gains that differ are most of the error of a
/// simulation.
bool makesLikelier(const AnswerLikelihood& with, const Estimate& without,
                   const Explanation& explanation) {
  const double far = with.held_out ? 50 : 100;  // [nats]
  const std::vector<Cause>& named = explanation.causes;
  const auto is_named = [&](const std::string& name) {
    return std::any_of(named.begin(), named.end(),
                       [&](const Cause& cause) { return cause.name == name; });
  };
  const bool is_of_answer =
      named.empty() || std::all_of(with.causes.begin(), with.causes.end(), is_named);
  if (!is_of_answer || with.samples != static_cast<double>(without.sample_count)) return false;
  return with.training > far - without.bic / 2 &&
         (!with.held_out || *with.held_out > without.validation.log_density_per_experiment);
}

/// Whether the answer of the search remains beside this model.
bool stands(const Explanation& explanation, const AnswerLikelihood& with_causes,
            const Estimate& without, const Split& data) {
  if (!agrees(without, kCheckThreshold) || makesLikelier(with_causes, without, explanation) ||
      isFoundTwice(explanation) || hasUnnamedCurves(explanation))
    return true;
  if (!leadingCurves(explanation.simulation).empty() && !without.trust.trusted) return true;
  if (standsForALine(explanation, without.nominal_model, longestOf(data.train))) return true;
  const bool passed_before = allPassed(explanation.checks_before);
  const std::optional<double> fit = fitAboutCommonMean(without, data);
  return std::any_of(explanation.causes.begin(), explanation.causes.end(), [&](const Cause& cause) {
    return !isOfSamples(cause) && isConfirmed(cause, without, fit, passed_before);
  });
}

/// Whether the model can be given as the answer: identify's own tests pass, the plant alone
/// explains most of the output, parts that were held out are not simulated far worse, and the model
/// is not that of a controller which computes the input from the output.
bool isAnswer(const Estimate& estimate, const Split& data) {
  constexpr double kUseful = 50, kAnyLevel = 1;  // [%] fit, and of the tests
  const NominalModelEstimate& nominal = estimate.nominal_model;
  const bool is_plant =
      trustOfDirection({}, followingOf(data.train), nominal.delay, true).trusted &&
      trustOfOrders({}, estimate.candidates, nominal.a.size(), estimate.simulation_fit_percent)
          .trusted;
  return is_plant && undampedFrequency(nominal, longestOf(data.train)) == 0 &&
         agrees(estimate, kAnyLevel) && estimate.simulation_fit_percent.value_or(0) >= kUseful &&
         simulationFitOf(estimate).value_or(0) >= kUseful;
}

Check checkOf(const std::string& name, double p_value) {
  Check check;
  check.name = name;
  check.statistic = std::nan("");
  check.p_value = p_value;
  return check;
}

/// The tests that isAnswer() asks for, which pass.
std::vector<Check> checksOf(const ResidualTests& tests) {
  return {checkOf("whiteness of predictions", tests.whiteness_p_value),
          checkOf("dependence on the input of predictions", tests.independence_p_value),
          checkOf("linearity of predictions", tests.linearity_p_value)};
}

std::string messageOf(const std::vector<Cause>& causes, const Estimate& estimate) {
  const bool differ = plantsDiffer(estimate),
             was_held_out = !estimate.validation.experiments.empty();
  std::string text = causes.empty() ? "" : describedNames(causes) + ". Apart from this, ";
  if (differ) text += "only the plants differ. " + estimate.variation + " With that, ";
  text +=
      "the model that identify chooses by default agrees with the data: its tests of the plant and "
      "of the noise's colour find nothing wrong.";
  if (!differ && !estimate.variation.empty()) text += " " + estimate.variation;
  if (const std::optional<double> fit = simulationFitOf(estimate))
    text += std::string(" Its simulation fits ") + (was_held_out ? "held-out data" : "the data") +
            " by " + rounded(*fit) + " %" + restInWords(*fit, differ);
  return text;
}

/// The linear plant describes the data as well, without causes but for those of the samples.
void withdrawCauses(Explanation* explanation) {
  std::vector<Cause> kept, withdrawn;
  for (const Cause& cause : explanation->causes)
    (isOfSamples(cause) ? kept : withdrawn).push_back(cause);
  if (withdrawn.empty()) return;
  explanation->warnings.push_back(namesOf(withdrawn) +
                                  ": not named, because the model that identify chooses passes "
                                  "its tests without it and simulates held-out data as well");
  explanation->causes = std::move(kept);
  SimulationCauses& simulation = explanation->simulation;
  simulation.causes.clear();
  simulation.fit_after = simulation.fit_before;
  forgetModelWithCauses(explanation);
  conclude(explanation, true);
}

/// What was said of the search's model, but for what is so whatever the model is.
void forgetSearch(Explanation* explanation) {
  std::vector<std::string>& warnings = explanation->warnings;
  const std::vector<std::string> kept{kNothingHeldOut, kOutOfTime,
                                      explanation->simulation.difference};
  const auto is_of_search = [&](const std::string& warning) {
    return std::find(kept.begin(), kept.end(), warning) == kept.end();
  };
  warnings.erase(std::remove_if(warnings.begin(), warnings.end(), is_of_search), warnings.end());
  explanation->pictures.clear();
  explanation->residual_before = explanation->residual_after = {};
}

void take(Estimate estimate, const Split& data, Explanation* explanation) {
  const std::string few = tooFewToTell(data.train.size(), simulationFitOf(estimate).value_or(0));
  if (explanation->verdict == Verdict::none) {
    if (plantsDiffer(estimate)) explanation->message = messageOf({}, estimate);
    return;
  }
  if (!few.empty()) {
    explanation->warnings.push_back(few);
    return withdrawCauses(explanation);
  }
  const std::string untested = failedOfNoise(explanation->checks_before);
  forgetSearch(explanation);
  withdrawCauses(explanation);
  const bool is_hurried = estimate.termination == Termination::time_limit;
  for (const auto* remarks : {&estimate.warnings, &estimate.trust.reasons})
    std::copy_if(remarks->begin(), remarks->end(), std::back_inserter(explanation->warnings),
                 [&](const std::string& remark) {  // its own limit is none that the user set
                   return !is_hurried || remark.find(estimate.message) == std::string::npos;
                 });
  if (is_hurried)
    explanation->warnings.push_back(
        "explanation.time_limit cut the choice of this model short; the best one is taken");
  explanation->verdict = explanation->causes.empty() ? Verdict::none : Verdict::explained;
  explanation->message = messageOf(explanation->causes, estimate);
  if (!untested.empty())
    explanation->message +=
        ". How its noise is distributed is not tested; tests of that fail in the model that the "
        "search for causes began with (" +
        untested + "), as with jumps, shocks or wrong readings";
  explanation->checks_before = explanation->checks_after = checksOf(estimate.residual_tests);
  if (!data.fitted_to)
    explanation->held_out_fit = estimate.validation.simulation_fit_percent_pooled;
  estimate.rejected = explanation->before.rejected;  // these were left out before the search
  explanation->before = explanation->after = std::move(estimate);
}

}  // namespace

void compareWithCauseFreeModel(const Configuration& asked, const Split& data,
                               const AnswerLikelihood& with_causes, SearchProgress& progress,
                               Explanation* explanation) {
  if (!leavesModelOpen(asked) || !isOpen(*explanation)) return;
  const bool is_none = explanation->verdict == Verdict::none;
  const auto go = [&](const Progress& at) {
    return progress.report("identifying with another error model", 0.95, at.log_likelihood);
  };
  Configuration limited = asked;
  limitTime(is_none ? kShareOfNone : kShare, &limited);
  try {
    Estimate estimate = Identifier(limited).identify(data.train, heldOutOf(data), go);
    estimate.configuration.estimation.time_limit = asked.estimation.time_limit;
    const bool is_hurried = estimate.termination == Termination::time_limit;
    const bool lacks_time =
        !estimate.usable() || (is_hurried && !agrees(estimate, kCheckThreshold));
    if (lacks_time && is_none) return;
    if (lacks_time)
      explanation->warnings.push_back(
          "there was no time to compare with the model that identify chooses, which may need no "
          "cause; a longer explanation.time_limit allows it");
    else if (stands(*explanation, with_causes, estimate, data))
      return;
    else if (isAnswer(estimate, data) && !saysLittle(estimate.trust, explanation->simulation) &&
             !isBehindLinear(estimate, simulationFitOf(estimate).value_or(0),
                             explanation->simulation))
      take(std::move(estimate), data, explanation);
    else
      withdrawCauses(explanation);
  } catch (const DataError& error) {
    explanation->warnings.push_back(
        std::string("the model that identify chooses by default could not be compared: ") +
        error.what());
  }
}

}  // namespace uncertainty_identification
