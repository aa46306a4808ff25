#include "explanation/poor_simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "data/text.h"
#include "explanation/named_causes.h"
#include "explanation/verdict.h"
#include "identification/steps.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

constexpr double kFar = 10;  // [%] fit

/// How well a model simulates.
struct Simulated {
  double fit = std::numeric_limits<double>::quiet_NaN();       ///< [%]
  double coverage = std::numeric_limits<double>::quiet_NaN();  ///< share in the 95 % intervals
};

Simulated simulatedBy(const Explanation& explanation) {
  Simulated simulated;
  const std::optional<double> own = explanation.held_out.empty()
                                        ? explanation.before.simulation_fit_percent
                                        : explanation.held_out_fit;
  simulated.fit = explanation.simulation.fit_after;
  // Where nothing is named, the answer is the model: larger plants may simulate windows well.
  const bool is_answer = explanation.causes.empty() || !std::isfinite(simulated.fit);
  if (is_answer && own) simulated.fit = std::fmin(simulated.fit, *own);
  for (const Cause& cause : explanation.causes) {
    if (!cause.gain || !std::isfinite(cause.gain->nrmse_fit_percent.after)) continue;
    simulated.fit = cause.gain->nrmse_fit_percent.after;
    simulated.coverage = cause.gain->coverage_95.after;
  }
  return simulated;
}

constexpr double kWell = 90;        // [%] fit
constexpr double kManyTimes = 2.5;  // the error

std::string lossInWords(const std::string& what, double fit, double ratio) {
  return what + " held-out data by " + rounded(fit) + " % only, with " + rounded(ratio) +
         " times the error that it has on the data it was fitted to: the plant is not linear, it "
         "has changed, the held-out data cover a range that the others do not, or those fitted to "
         "are too few";
}

/// That one linear plant, or the model, simulates held-out data with far more error than those it
/// was fitted to; empty where it does not, simulates them well all the same, or none are held out.
std::string lossOnHeldOut(const Explanation& explanation) {
  const SimulationCauses& simulation = explanation.simulation;
  if (explanation.held_out.empty()) return "";
  if (simulation.fit_before < kWell && simulation.held_out_error_ratio > kManyTimes)
    return lossInWords("one linear plant fits", simulation.fit_before,
                       simulation.held_out_error_ratio);
  const std::optional<double> own = explanation.before.simulation_fit_percent,
                              held_out = explanation.held_out_fit;
  if (!own || !held_out || *held_out >= kWell) return "";
  const double ratio = (100 - *held_out) / std::max(100 - *own, 1e-6);
  return ratio > kManyTimes ? lossInWords("the model simulates", *held_out, ratio) : "";
}

/// Whether one linear plant simulates windows of a few experiments far worse than the model does
/// whole experiments, each from a state and an offset of its own: a curve of the input looks like
/// that where each experiment has an input of another size.
bool isOfFewExperiments(const Explanation& explanation, double fit) {
  constexpr int kFew = 8;
  const SimulationCauses& simulation = explanation.simulation;
  const bool was_simulated = !simulation.preparation.empty();
  return was_simulated && explanation.before.experiment_count < kFew &&
         fit > simulation.fit_before + kFar;
}

/// What the tests do not see: most of the output, or what another linear model simulates, or how
/// uncertain the simulation is. Empty where it is none of them.
std::string shortcoming(const Explanation& explanation, const Simulated& simulated) {
  constexpr double kPoor = 50;          // [%] fit
  constexpr double kFewCovered = 0.75;  // of the samples
  const double linear = explanation.simulation.fit_before;
  const bool is_behind = isBehindLinear(explanation.before, simulated.fit, explanation.simulation);
  if (simulated.coverage < kFewCovered)
    return "the 95 % intervals of the simulation hold " + rounded(100 * simulated.coverage) +
           " % of the samples only: the model does not know how far its simulation is off";
  if (!(simulated.fit < kPoor) && !is_behind) return "";
  std::ostringstream text;
  text.precision(3);
  text << "the simulation fits " << (explanation.held_out.empty() ? "" : "held-out ") << "data by "
       << simulated.fit << " % only: ";
  if (is_behind)
    text << "a linear model fitted to its simulation reaches " << linear
         << " %, so the noise model describes what this one lacks";
  else
    text << "the input explains little of the output, the noise model describes the rest";
  text << ", and the tests cannot see what the simulation lacks";
  return text.str();
}

/// The same where no cause changes the simulation; also that held-out data are simulated far worse,
/// or that few experiments do not show whether they differ by chance.
std::string shortcomingWithoutStructure(const Explanation& explanation,
                                        const Simulated& simulated) {
  std::string lacks = lossOnHeldOut(explanation);
  if (lacks.empty()) lacks = shortcoming(explanation, simulated);
  if (!lacks.empty() || explanation.causes.empty()) return lacks;
  if (!isOfFewExperiments(explanation, simulated.fit)) return "";
  return "one linear plant simulates windows of the data by " +
         rounded(explanation.simulation.fit_before) +
         " % only; so few experiments do not show whether they differ by chance or with the input";
}

/// Whether what a simulation lacks looks like this cause.
bool isOfResiduals(const Cause& cause) {
  return cause.group == "noise" || (hasTrait(cause.name, Trait::outliers) && !isOfSamples(cause));
}

/// Withdraws what was found in the residuals of a simulation that lacks much. What the samples show
/// stays, except for steps of the sensor where the simulation is worse than a constant.
void withdraw(const std::string& lacks, bool is_worse_than_constant, Explanation* explanation) {
  std::vector<Cause>& causes = explanation->causes;
  const auto first = std::stable_partition(causes.begin(), causes.end(), [&](const Cause& cause) {
    return !isOfResiduals(cause) &&
           !(is_worse_than_constant && hasTrait(cause.name, Trait::quantisation));
  });
  const std::vector<Cause> withdrawn(first, causes.end());
  causes.erase(first, causes.end());
  if (!withdrawn.empty())
    explanation->warnings.push_back(namesOf(withdrawn) + ": not named, because " + lacks);
  if (causes.empty()) forgetModelWithCauses(explanation);
  explanation->verdict = causes.empty() ? Verdict::unknown : Verdict::partly_explained;
  explanation->message =
      causes.empty() ? "something is wrong that is not named: " + lacks
                     : describedNames(causes) + " is there, but explains only a part: " + lacks;
}

/// A reason of identify's, without its advice to try this program.
std::string withoutAdvice(const std::string& reason) {
  const std::size_t advice = reason.find("try explain");
  return advice == std::string::npos || advice < 2 ? reason : reason.substr(0, advice - 2);
}

/// Says how well the model without causes simulates. Where nothing is wrong, what the noise hides
/// is not seen; where something is, this says how much.
void tellFit(Explanation* explanation) {
  if (explanation->verdict == Verdict::none &&
      saysLittle(explanation->before.trust, explanation->simulation)) {
    explanation->verdict = Verdict::unknown;
    explanation->message =
        "the checks of the residuals find nothing wrong, but the data show little, and the model "
        "is not to be relied on: " +
        withoutAdvice(explanation->before.trust.reasons.front());
  }
  const bool was_held_out = explanation->held_out_fit.has_value();
  const std::optional<double> fit =
      was_held_out ? explanation->held_out_fit : explanation->before.simulation_fit_percent;
  if (!fit) return;
  explanation->message += std::string(explanation->verdict == Verdict::none
                                          ? ". Its simulation fits "
                                          : ". The simulation without a cause fits ") +
                          (was_held_out ? "held-out data" : "the data") + " by " + rounded(*fit) +
                          " %";
  const SimulationCauses& simulation = explanation->simulation;
  const bool showed_nothing =
      simulation.skipped.empty() && simulation.causes.empty() && simulation.refused.empty();
  if (showed_nothing && explanation->verdict == Verdict::none)
    explanation->message += restInWords(*fit, plantsDiffer(explanation->before));
  if (!simulation.skipped.empty())
    explanation->message += "; what it lacks was not looked for (" + simulation.skipped + ")";
}

}  // namespace

std::string restInWords(double fit, bool plants_differ) {
  constexpr double kMost = 50, kNearlyAll = 90;  // [%] fit
  if (!(fit >= kMost && fit < kNearlyAll)) return "";
  return "; the rest, " + rounded(100 - fit) + " % of the output's deviation, is taken for " +
         (plants_differ ? "the differences between experiments and " : "") +
         "what the input does not cause: noise of the sensor, a load, an input that was not "
         "recorded or a drift";
}

bool leavesDifferencesUntold(const Explanation& explanation) {
  const Estimate& before = explanation.before;
  const std::optional<double> fit =
      explanation.held_out_fit ? explanation.held_out_fit : before.simulation_fit_percent;
  return before.experiment_count > 1 && fit && !restInWords(*fit, true).empty();
}

std::string tooFewToTell(std::size_t experiments, double fit) {
  constexpr std::size_t kFew = 8;
  constexpr double kWell = 75;  // [%] fit
  if (experiments < 2 || experiments >= kFew || fit >= kWell) return "";
  return "the model that identify chooses by default passes its tests, but simulates by " +
         rounded(fit) + " % only: so few experiments (" + std::to_string(experiments) +
         " are fitted to) do not show whether they differ by chance or with the input";
}

bool saysLittle(const Trust& trust, const SimulationCauses& simulation) {
  return !simulation.skipped.empty() && !trust.trusted && !trust.reasons.empty();
}

bool isBehindLinear(const Estimate& model, double fit, const SimulationCauses& simulation) {
  const bool own_offsets = model.configuration.estimation.offsets == Offsets::per_experiment;
  const bool holds_line = simulation.lasting_oscillation > 0;
  return !own_offsets && !holds_line && fit < simulation.fit_before - kFar;
}

void warnOfPoorSimulation(Explanation* explanation) {
  const std::vector<Cause>& causes = explanation->causes;
  const bool is_aside = std::all_of(causes.begin(), causes.end(), [](const Cause& cause) {
    return !cause.simulation && (isOfSamples(cause) || isOfResiduals(cause));
  });
  if (explanation->verdict == Verdict::partly_explained && !is_aside) return;
  const Simulated simulated = simulatedBy(*explanation);
  if (explanation->verdict == Verdict::unknown) {
    const std::string lacks = shortcomingWithoutStructure(*explanation, simulated);
    if (!lacks.empty()) explanation->warnings.push_back(lacks);
    tellFit(explanation);
    return;
  }
  const std::string lacks = is_aside ? shortcomingWithoutStructure(*explanation, simulated)
                                     : shortcoming(*explanation, simulated);
  if (causes.empty() || !is_aside) {
    if (lacks.empty() && causes.empty()) tellFit(explanation);
    if (lacks.empty()) return;
    explanation->warnings.push_back(lacks);
    if (!causes.empty()) return;
    // A fit that is low without another model that does better may be due to much noise.
    if (simulated.fit < 0 || lacks == lossOnHeldOut(*explanation) ||
        isBehindLinear(explanation->before, simulated.fit, explanation->simulation))
      explanation->verdict = Verdict::unknown;
    explanation->message = "the checks of the residuals find nothing wrong, but " + lacks;
    return;
  }
  if (!lacks.empty())
    withdraw(lacks, simulated.fit < 0, explanation);
  else if (std::isfinite(simulated.fit) && explanation->verdict == Verdict::explained)
    explanation->message += ". The simulation is the same with it and fits " +
                            std::string(explanation->held_out.empty() ? "" : "held-out ") +
                            "data by " + rounded(simulated.fit) + " %";
}

}  // namespace uncertainty_identification
