#include "explanation/simulation_answer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "curves/curve_words.h"
#include "data/text.h"
#include "explanation/acceptance.h"
#include "explanation/confirmation.h"
#include "explanation/doubtful_curves.h"
#include "explanation/equivalent_curves.h"
#include "explanation/named_causes.h"
#include "explanation/poor_simulation.h"
#include "explanation/residual_checks.h"
#include "explanation/unconfirmed_causes.h"
#include "explanation/verdict.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Logarithm of the ratio of squared errors, by fits [%].
double logRatio(double before, double after) {
  return 2 * std::log(std::max(100 - after, 1e-6) / std::max(100 - before, 1e-6));
}

/// The same of all causes of the likelihood together.
double likelihoodRatio(const std::vector<Cause>& causes) {
  double sum = 0;
  for (const Cause& cause : causes)
    if (cause.gain && std::isfinite(cause.gain->nrmse_fit_percent.after))
      sum += logRatio(cause.gain->nrmse_fit_percent.before, cause.gain->nrmse_fit_percent.after);
  return sum;
}

Cause ofSimulation(const SimulationCause& found) {
  constexpr double kNormal90 = 1.6449;
  Cause cause;
  cause.name = found.what.name;
  cause.variant = found.what.covariate;
  cause.group = found.what.name.rfind("act_", 0) == 0    ? "actuator"
                : found.what.name.rfind("sens_", 0) == 0 ? "sensor"
                : found.what.name.rfind("exp_", 0) == 0  ? "experiment"
                                                         : "plant";
  cause.description = found.description;
  cause.advice = found.advice;
  cause.confidence = kNan;
  for (const PlaceAndShape& tie : found.ties)
    if (tie.name != cause.name && std::find(cause.equivalent.begin(), cause.equivalent.end(),
                                            tie.name) == cause.equivalent.end())
      cause.equivalent.push_back(tie.name);
  for (const ShapeValue& value : found.values)
    cause.parameters.push_back({value.name, "", value.value, value.standard_error,
                                value.value - kNormal90 * value.standard_error,
                                value.value + kNormal90 * value.standard_error});
  const Comparison none{kNan, kNan};
  cause.gain = Gain{kNan, kNan, kNan, kNan, {found.fit_before, found.fit_after},
                    none, none, none, none, none};
  cause.simulation = found;
  return cause;
}

/// The curves are the causes. A cause of the likelihood of the same name lends its values and
/// gains.
void takeCurves(Explanation* explanation) {
  std::vector<Cause> causes, dropped;
  for (const SimulationCause& found : explanation->simulation.causes)
    causes.push_back(ofSimulation(found));
  for (Cause& cause : explanation->causes) {
    const bool is_curve = std::any_of(causes.begin(), causes.end(),
                                      [&](const Cause& other) { return other.name == cause.name; });
    if (isOfSamples(cause) && !is_curve)
      causes.push_back(std::move(cause));
    else if (!is_curve)
      dropped.push_back(std::move(cause));
  }
  if (!dropped.empty())
    explanation->warnings.push_back(
        namesOf(dropped) +
        ": found by the likelihood of a model that cannot contain what the simulation shows, and "
        "therefore not named");
  explanation->causes = std::move(causes);
  forgetModelWithCauses(explanation);
  explanation->verdict = Verdict::partly_explained;
  std::ostringstream text;
  text.precision(3);
  for (std::size_t k = 0; k < explanation->simulation.causes.size(); ++k)
    text << (k > 0 ? "; " : "") << explanation->simulation.causes[k].description << " ("
         << explanation->simulation.causes[k].what.name << ")";
  text << ": the fit of simulating held-out data rises from " << explanation->simulation.fit_before
       << " to " << explanation->simulation.fit_after
       << " %. The identified model with its noise and its mixture does not contain this, so the "
          "tests of its residuals still fail";
  explanation->message = text.str();
}

/// [%] of fit without causes: of windows of what is held out, by a linear plant that was fitted to
/// nothing but its simulation, or, where nothing is held out, by the identified model. A
/// fit of up to 30 % may come from the states alone that windows begin from, and counts as 0.
std::optional<double> fitWithoutCauses(const Explanation& explanation) {
  constexpr double kOfStates = 30;  // [%]
  const SimulationCauses& simulation = explanation.simulation;
  if (explanation.held_out.empty()) return explanation.before.simulation_fit_percent;
  if (simulation.preparation.empty() || simulation.ended_early) return std::nullopt;
  return simulation.fit_before > kOfStates ? simulation.fit_before : 0;
}

/// The likelihood's model may simulate far worse than one without causes, even with all of them. A
/// cause then mends that model, and not what the plant lacks. It is dropped with what was found on
/// top of it. Where data are held out, they show of other causes than curves whether they gain.
void dropCausesThatSimulateWorse(Explanation* explanation) {
  constexpr double kFarWorse = 1.5, kPoints = 10;  // of the error; [% of fit]
  const std::optional<double> fit_without = fitWithoutCauses(*explanation);
  std::vector<Cause>& causes = explanation->causes;
  const auto is_worse = [&](const Cause& cause) {
    const double with = 100 - cause.gain->nrmse_fit_percent.after, without = 100 - *fit_without;
    return with > kFarWorse * without && with > without + kPoints;
  };
  const auto counts = [](const Cause& cause) { return isStructural(cause) && cause.gain; };
  const auto last = std::find_if(causes.rbegin(), causes.rend(), counts);
  if (!fit_without || last == causes.rend() || !is_worse(*last)) return;
  const double with = last->gain->nrmse_fit_percent.after;
  const bool in_sample = explanation->held_out.empty();
  const auto first = std::find_if(causes.begin(), causes.end(), [&](const Cause& cause) {
    return counts(cause) && (in_sample || isCurveCause(cause.name)) && is_worse(cause);
  });
  const auto rest = std::stable_partition(first, causes.end(), isOfSamples);
  if (rest == causes.end()) return;
  const std::vector<Cause> dropped(rest, causes.end());
  causes.erase(rest, causes.end());
  explanation->warnings.push_back(namesOf(dropped) + ": with this the model simulates " +
                                  (in_sample ? "the experiments" : "held-out experiments") +
                                  " by " + rounded(with) + " % only, " +
                                  (in_sample ? "and the identified one without it by "
                                             : "and a linear plant windows of them by ") +
                                  rounded(*fit_without) + " %; not named");
  if (causes.empty()) forgetModelWithCauses(explanation);
  conclude(explanation, true);
}

/// What makes the residuals white may stand for what the simulation lacks. Where the data or
/// the steps of the input are too few to search for that, a structural cause has to make the
/// simulation of held-out experiments better, and a curve to halve its error. Where none are held
/// out, every parameter makes it better: the free simulation must show the cause in windows that
/// were left out, be it in windows of one length, the last thirds of the records confirm it or, of
/// a kind that it cannot show, the cause halve the error. A constant only guesses the states better
/// that the records begin from.
void dropUnverified(const std::optional<LastThirds>& last_thirds, Explanation* explanation) {
  const std::string& skipped = explanation->simulation.skipped;
  const bool few_data = skipped.rfind("fewer than", 0) == 0;
  const bool too_few = skipped.find("fewer than") != std::string::npos;  // data, or steps
  const bool in_sample = explanation->held_out.empty();
  if (!too_few && !in_sample) return;
  constexpr double kBetter = 0.95, kHalved = 0.5;  // of the squared error
  const std::string confirmation = few_data ? "" : confirmationOf(last_thirds, *explanation);
  const bool twice = !few_data && isFoundTwice(*explanation);
  const auto gains_enough = [&](const Cause& cause) {
    if (twice || !confirmation.empty()) return true;
    if (in_sample &&
        (few_data || isCurveCause(cause.name) || hasTrait(cause.name, Trait::constant)))
      return false;
    return errorRatio(*cause.gain) < (in_sample || isCurveCause(cause.name) ? kHalved : kBetter);
  };
  const auto first = std::stable_partition(
      explanation->causes.begin(), explanation->causes.end(), [&](const Cause& cause) {
        return !isStructural(cause) || !cause.gain || cause.simulation || gains_enough(cause);
      });
  if (first == explanation->causes.end()) {
    if (!confirmation.empty()) explanation->warnings.push_back(confirmation);
    return;
  }
  const std::vector<Cause> dropped(first, explanation->causes.end());
  explanation->causes.erase(first, explanation->causes.end());
  explanation->warnings.push_back(
      namesOf(dropped) + ": makes the residuals white, but " +
      (in_sample ? "no experiment is held out that confirms it"
                 : "the simulation not clearly better") +
      ", and " +
      (too_few ? "curves are not looked for in the simulation (" + skipped + ")"
               : "the simulation does not clearly show it") +
      "; not named" + (in_sample ? ": give another record by --validation" : ""));
  const std::string left = dropCurvesThatLeaveMost(&explanation->simulation);
  if (!left.empty()) explanation->warnings.push_back(left);
  if (!explanation->simulation.causes.empty() &&
      std::none_of(explanation->causes.begin(), explanation->causes.end(), isStructural))
    return takeCurves(explanation);
  if (explanation->causes.empty()) forgetModelWithCauses(explanation);
  conclude(explanation, true);
}

/// Gives the likelihood's causes the curves of the same name.
void lendCurves(Explanation* explanation) {
  for (Cause& cause : explanation->causes)
    for (const SimulationCause& found : explanation->simulation.causes)
      if (found.what.name == cause.name) cause.simulation = found;
}

void joinCurves(Explanation* explanation) {
  const SimulationCauses& simulation = explanation->simulation;
  const bool passed = allPassed(explanation->checks_after);
  if (simulation.causes.empty()) {
    if (passed) return;
    dropUnconfirmed(explanation);
    if (!isOfNoiseAlone(explanation->checks_after)) dropBesideWithheld(explanation);
    dropNotShown(explanation);
    return;
  }
  const double by_curves = logRatio(simulation.fit_before, simulation.fit_after);
  // Where all tests pass, only a curve that takes half of the error away is believed instead.
  const bool stands = passed && (!takeHalfAway(simulation) ||
                                 likelihoodRatio(explanation->causes) <= 0.5 * by_curves);
  if (stands)
    lendCurves(explanation);
  else
    takeCurves(explanation);
}

/// Says of a cause that was found twice that it is named, in place of the end of what was said of
/// it as one that is not confirmed.
void sayNamedAllTheSame(Explanation* explanation) {
  static const std::string kNotNamed = "Not named";
  const auto cause =
      std::find_if(explanation->causes.begin(), explanation->causes.end(), isStructural);
  const std::string named =
      cause->name + " is named all the same: the likelihood of all samples asks for the same cause";
  std::vector<std::string>& warnings = explanation->warnings;
  const auto refused = std::find(warnings.begin(), warnings.end(), explanation->simulation.refused);
  const std::size_t end = refused == warnings.end() ? std::string::npos : refused->rfind(kNotNamed);
  if (end == std::string::npos)
    warnings.push_back(named);
  else
    refused->replace(end, kNotNamed.size(), named);
}

/// The verdict is not `none` where the free simulation gains by curves, although all tests pass
/// without them.
void doubtNothing(Explanation* explanation) {
  const SimulationCauses& simulation = explanation->simulation;
  if (explanation->verdict != Verdict::none || !hasUnnamedCurves(*explanation)) return;
  explanation->verdict = Verdict::unknown;
  explanation->message =
      "the checks of the residuals find nothing wrong, but the fit of simulating held-out data "
      "rises "
      "from " +
      rounded(simulation.fit_before) + " to " + rounded(simulation.fit_after) + " % by " +
      namesOf(simulation) +
      "; not named, because that takes away less than half of the squared error";
}

}  // namespace

std::vector<std::string> leadingCurves(const SimulationCauses& simulation) {
  std::vector<std::string> names;
  if (!takeHalfAway(simulation)) return names;
  for (const SimulationCause& cause : simulation.causes) {
    names.push_back(cause.what.name);
    for (const PlaceAndShape& tie : cause.ties) names.push_back(tie.name);
  }
  return names;
}

void joinSimulation(Explanation* explanation, const std::optional<LastThirds>& last_thirds) {
  if (!allPassed(explanation->checks_after)) dropCurvesThatLeaveMost(&explanation->simulation);
  if (!explanation->simulation.refused.empty())
    explanation->warnings.push_back(explanation->simulation.refused);
  if (!explanation->simulation.difference.empty())
    explanation->warnings.push_back(explanation->simulation.difference);
  if (explanation->simulation.skipped.empty()) joinCurves(explanation);
  if (explanation->simulation.causes.empty()) dropCausesThatSimulateWorse(explanation);
  dropUnverified(last_thirds, explanation);
  tellEquivalentCurves(explanation);
  if (isFoundTwice(*explanation)) sayNamedAllTheSame(explanation);
  warnOfPoorSimulation(explanation);
  doubtNothing(explanation);
}

}  // namespace uncertainty_identification
