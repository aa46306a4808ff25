#include "explanation/simulation_answer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "curves/curve_words.h"
#include "data/text.h"
#include "explanation/acceptance.h"
#include "explanation/residual_checks.h"
#include "explanation/sample_checks.h"
#include "explanation/verdict.h"

namespace uncertainty_identification {
namespace {

const double kHalf = std::log(0.5);  ///< of the squared error
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Found in the samples themselves or by a test of the input: no curve can imitate them.
bool isOfSamples(const Cause& cause) {
  const auto traits = {Trait::quantisation, Trait::held_samples, Trait::output_limit,
                       Trait::feedback};
  return std::any_of(traits.begin(), traits.end(),
                     [&](Trait trait) { return hasTrait(cause.name, trait); });
}

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

std::string namesOf(const std::vector<Cause>& causes) {
  std::string names;
  for (const Cause& cause : causes) names += (names.empty() ? "" : ", ") + cause.name;
  return names;
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

/// The model with causes is the one without.
void forgetModelWithCauses(Explanation* explanation) {
  explanation->after = explanation->before;
  explanation->checks_after = explanation->checks_before;
  explanation->residual_after = explanation->residual_before;
  for (ExperimentPicture& picture : explanation->pictures) {
    picture.simulated_after = picture.simulated_before;
    picture.deviation_after = picture.deviation_before;
  }
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

/// Causes with which tests fail, and that gain too little on held-out data. Those that a simulation
/// must show have to be clear there; of others, and where no simulation is useful, the log density
/// has to gain with 95 %.
void dropUnconfirmed(Explanation* explanation) {
  constexpr double kUseful = 30;  // [%] fit
  const std::vector<std::string> curves = curveCauseNames();
  const auto is_unconfirmed = [&](const Cause& cause) {
    if (isOfSamples(cause) || !cause.gain) return false;
    const bool useful = cause.gain->nrmse_fit_percent.after >= kUseful;
    const bool simulates = useful && isClear(*cause.gain);
    const bool is_curve = std::find(curves.begin(), curves.end(), cause.name) != curves.end();
    return !simulates && ((useful && is_curve) || !(cause.gain->lower_90 > 0));
  };
  const auto first =
      std::stable_partition(explanation->causes.begin(), explanation->causes.end(),
                            [&](const Cause& cause) { return !is_unconfirmed(cause); });
  if (first == explanation->causes.end()) return;
  const std::vector<Cause> dropped(first, explanation->causes.end());
  explanation->causes.erase(first, explanation->causes.end());
  explanation->warnings.push_back(namesOf(dropped) +
                                  ": raises the likelihood, but neither held-out data nor a useful "
                                  "simulation confirm it, and tests still fail; not named");
  if (explanation->causes.empty()) forgetModelWithCauses(explanation);
  conclude(explanation, true);
}

/// Where the data are too few to search for what the simulation lacks, what makes the residuals
/// white may stand for it: a cause in the plant or its sensor and actuator has to make the
/// simulation of held-out experiments better.
void dropUnsimulated(Explanation* explanation) {
  constexpr double kBetter = 0.95;  // of the error
  if (explanation->simulation.skipped.rfind("fewer than", 0) != 0) return;
  const bool in_sample = explanation->held_out.empty();
  const auto is_doubtful = [&](const Cause& cause) {
    const bool changes = cause.group == "plant" || cause.group == "actuator" ||
                         (cause.group == "sensor" && !isOfSamples(cause));
    return changes && cause.gain && (in_sample || !(errorRatio(*cause.gain) < kBetter));
  };
  const auto first = std::stable_partition(explanation->causes.begin(), explanation->causes.end(),
                                           [&](const Cause& each) { return !is_doubtful(each); });
  if (first == explanation->causes.end()) return;
  const std::vector<Cause> dropped(first, explanation->causes.end());
  explanation->causes.erase(first, explanation->causes.end());
  explanation->warnings.push_back(
      namesOf(dropped) + ": makes the residuals white, but " +
      (in_sample ? "no experiment is held out that confirms it" : "the simulation no better") +
      ", and " + explanation->simulation.skipped +
      " do not show what the simulation lacks; not named");
  forgetModelWithCauses(explanation);
  conclude(explanation, true);
}

/// Gives the likelihood's causes the curves of the same name.
void lendCurves(Explanation* explanation) {
  for (Cause& cause : explanation->causes)
    for (const SimulationCause& found : explanation->simulation.causes)
      if (found.what.name == cause.name) cause.simulation = found;
}

/// Whether another linear model simulates the data far better than by `fit` %.
bool isBehind(const SimulationCauses& simulation, double fit) {
  constexpr double kFar = 10;  // [%] fit
  return fit < simulation.fit_before - kFar;
}

/// What the tests do not see of a simulation that fits by `fit` %, and whose 95 % intervals hold
/// the share `coverage` of the samples: most of the output, or what another linear model simulates,
/// or how uncertain it is. Empty where it is none of them.
std::string shortcoming(const SimulationCauses& simulation, double fit, double coverage) {
  constexpr double kPoor = 50;          // [%] fit
  constexpr double kFewCovered = 0.75;  // of the samples
  const bool is_behind = isBehind(simulation, fit);
  if (coverage < kFewCovered)
    return "the 95 % intervals of the simulation hold " + rounded(100 * coverage) +
           " % of the samples only: the model does not know how far its simulation is off";
  if (!(fit < kPoor) && !is_behind) return "";
  std::ostringstream text;
  text.precision(2);
  text << "the simulation fits held-out data by " << fit << " % only: ";
  if (is_behind)
    text << "a linear model fitted to its simulation reaches " << simulation.fit_before
         << " %, so the noise model describes what this one lacks";
  else
    text << "the input explains little of the output, the noise model describes the rest";
  text << ", and the tests cannot see what the simulation lacks";
  return text.str();
}

/// Tests of what cannot be predicted may pass though the simulation lacks much, even though a
/// constant would simulate better. What the samples or the noise shows does not explain that.
void warnOfPoorSimulation(Explanation* explanation) {
  const std::vector<Cause>& causes = explanation->causes;
  if (explanation->verdict != Verdict::none && explanation->verdict != Verdict::explained) return;
  const SimulationCauses& simulation = explanation->simulation;
  double fit = simulation.skipped.empty() ? simulation.fit_after : kNan;
  double coverage = kNan;
  for (const Cause& cause : causes) {
    if (cause.gain && std::isfinite(cause.gain->nrmse_fit_percent.after)) {
      fit = cause.gain->nrmse_fit_percent.after;
      coverage = cause.gain->coverage_95.after;
    }
  }
  const std::string lacks = shortcoming(simulation, fit, coverage);
  if (!lacks.empty()) explanation->warnings.push_back(lacks);
  if (causes.empty() && !lacks.empty()) {
    if (fit < 0) explanation->verdict = Verdict::unknown;
    explanation->message = "the checks of the residuals find nothing wrong, but " + lacks;
  }
  const bool is_aside = std::all_of(causes.begin(), causes.end(), [&](const Cause& cause) {
    return isOfSamples(cause) || cause.group == "noise" || hasTrait(cause.name, Trait::outliers);
  });
  if (causes.empty() || !is_aside || (lacks.empty() && !std::isfinite(fit))) return;
  if (lacks.empty()) {
    explanation->message += ". The simulation is the same with it and fits " +
                            std::string(explanation->held_out.empty() ? "" : "held-out ") +
                            "data by " + rounded(fit) + " %";
    return;
  }
  explanation->verdict = Verdict::partly_explained;
  explanation->message = describedNames(causes) +
                         ": with this in the model all checks of the residuals pass, but " + lacks;
}

void joinCurves(Explanation* explanation) {
  const SimulationCauses& simulation = explanation->simulation;
  const bool passed = allPassed(explanation->checks_after);
  if (simulation.causes.empty()) {
    if (!passed) dropUnconfirmed(explanation);
    return;
  }
  const double by_curves = logRatio(simulation.fit_before, simulation.fit_after);
  // Where all tests pass, only a curve that takes half of the error away is believed instead.
  const bool stands =
      passed && (by_curves > kHalf || likelihoodRatio(explanation->causes) <= 0.5 * by_curves);
  if (stands)
    lendCurves(explanation);
  else
    takeCurves(explanation);
}

}  // namespace

std::vector<std::string> leadingCurves(const SimulationCauses& simulation) {
  std::vector<std::string> names;
  if (logRatio(simulation.fit_before, simulation.fit_after) > kHalf) return names;
  for (const SimulationCause& cause : simulation.causes) {
    names.push_back(cause.what.name);
    for (const PlaceAndShape& tie : cause.ties) names.push_back(tie.name);
  }
  return names;
}

void dropPlayOfSensorSteps(const std::vector<Experiment>& fitted, SimulationCauses* simulation) {
  constexpr double kHardlyWider = 1.5;  // half widths, in steps
  if (simulation->causes.size() != 1 || simulation->causes[0].what.shape != "output_play") return;
  const double half_width = simulation->causes[0].values.at(0).value;
  for (const SpoiltSamples& spoilt : checkSamples(withoutRest(fitted))) {
    if (spoilt.trait != Trait::quantisation) continue;
    const double step = spoilt.parameters.front().value;
    if (half_width >= kHardlyWider * step) continue;
    simulation->refused = simulation->causes[0].what.name + ": a play of half width " +
                          rounded(half_width) + " is hardly wider than the steps of " +
                          rounded(step) + " in which the sensor reads, and simulates as these do";
    simulation->causes.clear();
    simulation->fit_after = simulation->fit_before;
    for (SimulatedWindow& window : simulation->pictures) window.after = window.before;
    return;
  }
}

void joinSimulation(Explanation* explanation) {
  if (!explanation->simulation.refused.empty())
    explanation->warnings.push_back(explanation->simulation.refused);
  if (explanation->simulation.skipped.empty())
    joinCurves(explanation);
  else
    dropUnsimulated(explanation);
  warnOfPoorSimulation(explanation);
}

}  // namespace uncertainty_identification
