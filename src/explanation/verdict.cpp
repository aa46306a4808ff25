#include "explanation/verdict.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "data/text.h"
#include "explanation/acceptance.h"
#include "explanation/input_lines.h"
#include "explanation/prediction_checks.h"
#include "explanation/residual_checks.h"
#include "explanation/wording.h"

namespace uncertainty_identification {
namespace {

std::string messageOf(Verdict verdict, const std::string& names, const std::string& failed) {
  switch (verdict) {
    case Verdict::none:
      return "the model agrees with the data: the checks of its residuals find nothing wrong";
    case Verdict::explained:
      return names + ": with this in the model all checks of the residuals pass";
    case Verdict::partly_explained:
      return names + " explains part of what is wrong; these checks still fail: " + failed;
    case Verdict::unknown:
      return "something is wrong that the catalogue does not describe; these checks fail: " +
             failed;
  }
  return "";
}

/// The catalogue may well describe what is wrong.
std::string unfinished(const std::string& failed) {
  return "no cause was confirmed before the search ended at explanation.time_limit; these checks "
         "fail: " +
         failed + ". Give it more time, or fewer or shorter experiments";
}

std::string notNamed(const std::string& failed) {
  return "something is wrong, and what would describe it is not named as a cause, for reasons that "
         "the warnings tell; these checks fail: " +
         failed;
}

std::string partlyNamed(const std::string& names) {
  return names +
         " explains part of what is wrong; what would describe the rest is not named as a cause, "
         "for reasons that the warnings tell";
}

std::string ofNoiseAlone(const std::string& failed, bool withheld) {
  return std::string(
             "the checks of the plant find nothing wrong, but the noise is not what the "
             "model assumes, ") +
         (withheld ? "and what would describe it is not named as a cause, for reasons that the "
                     "warnings tell"
                   : "in a way that the catalogue does not describe") +
         "; these checks fail: " + failed;
}

std::string ofUnclearDirection(int delay) {
  const std::string what = "the input and the output move within the same reading, ";
  const std::string record = "record an input that does not depend on the output";
  if (delay > 0)
    return what +
           "although the model answers later: a controller probably computes the input from the "
           "output, and the noise that it feeds back biases the model; " +
           record;
  return what +
         "so that the data do not show which causes the other: where a controller computes the "
         "input from the output, the model is the inverse of the controller. If the output really "
         "answers at once, state nominal_model: {delay: 0} and the orders; otherwise " +
         record;
}

std::string joined(const std::string& list, const std::string& name) {
  return list.empty() ? name : list + ", " + name;
}

/// Whether a cause is noise that a single record shows, and no other one clearly confirms.
bool isUnconfirmedNoise(const FoundCause& found, const SearchState& state) {
  constexpr double kClear = 6;  // [nats] of held-out records
  const bool confirmed = !state.fitted_to && found.gain && found.gain->log_density > kClear;
  return state.train.count() == 1 && !confirmed && groupOf(found.effect->name()) == "noise";
}

/// Whether a line in the spectrum may be the model's error in the response to a line of the input.
bool isLineOfInput(const FoundCause& found, const SearchState& state) {
  if (!found.effect->has(Trait::spectral_line) || !state.fit.model) return false;
  const Effects& effects = state.fit.model->effects();
  const auto at = std::find(effects.begin(), effects.end(), found.effect);
  const auto& parameters = found.effect->description().parameters;
  const auto frequency =
      std::find_if(parameters.begin(), parameters.end(),
                   [](const EffectParameter& each) { return each.name == "frequency"; });
  if (at == effects.end() || frequency == parameters.end()) return false;
  const int first = state.fit.model->offsetOf(static_cast<std::size_t>(at - effects.begin()));
  const double value = state.fit.at.parameters[first + (frequency - parameters.begin())];
  const std::vector<Experiment>& train = state.train.experiments();
  return mayComeFromInput(value * train.front().sample_time, train);
}

/// Whether a constant of the input may only complete the cause: one of actuator or plant.
bool mayNeedConstant(const FoundCause& cause) {
  return !cause.effect->has(Trait::constant) && !isOfNoise(*cause.effect) &&
         !isOfMixture(*cause.effect) && cause.effect->stage() <= Stage::output;
}

}  // namespace

const EnumNames<Verdict>& enumNames(Verdict) {
  static const EnumNames<Verdict> kNames{{Verdict::none, "none"},
                                         {Verdict::explained, "explained"},
                                         {Verdict::partly_explained, "partly_explained"},
                                         {Verdict::unknown, "unknown"}};
  return kNames;
}

namespace {

bool isOfNoise(const Check& check) {
  static const std::set<std::string> kOfNoise{"tails", "volatility", "symmetry",
                                              "variance over time", "variance over experiments"};
  return kOfNoise.count(check.name) > 0;
}

}  // namespace

bool isOfNoiseAlone(const std::vector<Check>& checks) {
  return std::all_of(checks.begin(), checks.end(),
                     [](const Check& check) { return check.passed || isOfNoise(check); });
}

std::string failedOfNoise(const std::vector<Check>& checks) {
  std::string failed;
  for (const Check& check : checks)
    if (!check.passed && isOfNoise(check)) failed = joined(failed, check.name);
  return failed;
}

bool isSymptom(const FoundCause& found, const SearchState& state, bool fail_of_noise_only) {
  constexpr double kFarMore = 4.0 / 3;
  if (found.score == 0) return false;    // seen in the samples themselves
  constexpr double kOverwhelming = 100;  // [nats]
  if (isOfNoise(*found.effect)) return true;
  if (found.effect->has(Trait::spectral_line))
    return !fail_of_noise_only || found.score < kOverwhelming;
  return std::any_of(state.causes.begin(), state.causes.end(), [&](const FoundCause& other) {
    return other.score > found.score * (isOfNoise(*other.effect) ? kFarMore : 1);
  });
}

bool isBesideSimulation(const FoundCause& found) {
  constexpr double kSame = 0.99;  // of the squared error
  constexpr double kMuch = 100;   // [nats]
  const Effect& effect = *found.effect;
  const bool acts_on_simulation = !isOfMixture(effect) && !isOfNoise(effect) &&
                                  !effect.has(Trait::by_experiment) &&
                                  !effect.has(Trait::spectral_line);
  return acts_on_simulation && found.gain && found.score > 0 && found.score < kMuch &&
         errorRatio(*found.gain) > kSame;
}

std::string reasonNotToName(const FoundCause& found, const SearchState& state,
                            const TestsAround& tests) {
  if (found.effect->has(Trait::constant))
    for (const FoundCause& other : state.causes)
      if (mayNeedConstant(other) && !reasonNotToName(other, state, tests).empty())
        return named(*found.effect) + ": beside " + named(*other.effect) +
               ", which is not named, it says nothing by itself; not named";
  if (found.may_be_order)
    return named(*found.effect) +
           ": the orders of the model were chosen, not stated, and one order more may be all that "
           "this describes; it is not named as a cause";
  if (tests.passed_before && isBesideSimulation(found))
    return named(*found.effect) + " makes the data more likely by " + rounded(found.score) +
           " nats, but all tests pass without it, and the simulation is the same with it: it may "
           "only be a better guess of the states that the records begin from; it is not named as a "
           "cause";
  if (found.effect->has(Trait::spectral_line) &&
      std::any_of(state.causes.begin(), state.causes.end(),
                  [](const FoundCause& other) { return other.may_be_order; }))
    return named(*found.effect) +
           ": an order that the model lacks was found beside it, and a resonance that swings on "
           "leaves "
           "nearly a line as well; it is not named as a cause";
  if (isLineOfInput(found, state))
    return named(*found.effect) +
           ": the input has a line in its spectrum there, or at a fraction of that frequency, so "
           "that it may be the response to the input that the model lacks; it is not named as a "
           "cause";
  if (tests.passed && isUnconfirmedNoise(found, state))
    return named(*found.effect) +
           " would describe the residuals, but a single record does not tell noise from what the "
           "model lacks; it is not named as a cause: record again, or give another record by "
           "--validation";
  const std::vector<std::string>& simulated = tests.simulated;
  if (std::find(simulated.begin(), simulated.end(), found.effect->name()) != simulated.end())
    return "";
  if (tests.passed || !isSymptom(found, state, tests.fail_of_noise_only)) return "";
  return named(*found.effect) +
         " describes part of what is wrong, but may be only a symptom: not all of it is explained";
}

bool isInEveryExperiment(const FoundCause& found) {
  const Effect& effect = *found.effect;
  return found.score > 0 && !found.may_be_order && !isOfNoise(effect) && !isOfMixture(effect) &&
         !effect.has(Trait::by_experiment);
}

void doubtAgreement(const SearchState& found, Explanation* explanation) {
  constexpr double kFarMoreLikely = 30;  // [nats]
  if (explanation->verdict != Verdict::none) return;
  double gain = 0;
  std::string names;
  for (const FoundCause& cause : found.causes) {
    if (!isInEveryExperiment(cause) || isBesideSimulation(cause)) continue;
    gain += cause.score;
    names = joined(names, named(*cause.effect));
  }
  if (gain < kFarMoreLikely) return;
  explanation->verdict = Verdict::unknown;
  explanation->message = "the checks of the residuals find nothing wrong without a cause, but " +
                         names + " would make the data far more likely (by " + rounded(gain) +
                         " nats); it is not named as a cause, for reasons that the warnings tell";
}

Check parsimony(const SearchState& state) {
  constexpr double kPrior = 0.005;  // probability that an effect is there
  const auto causes =
      std::count_if(state.causes.begin(), state.causes.end(), [](const FoundCause& cause) {
        return cause.score != 0 && !isOfNoise(*cause.effect) && !cause.may_be_order;
      });
  const double p_value = std::pow(kPrior, static_cast<double>(causes));
  const bool passed = !(p_value < kCheckThreshold);
  return {"parsimony", static_cast<double>(causes), p_value, passed,
          passed ? "" : "so many causes at once are unlikely; the catalogue may lack the true one"};
}

void addFailedParsimony(const SearchState& base, const SearchState& named,
                        Explanation* explanation) {
  const Check check = parsimony(named);
  if (check.passed) return;
  explanation->checks_before.push_back(parsimony(base));
  explanation->checks_after.push_back(check);
}

std::string describedNames(const std::vector<Cause>& causes) {
  std::string names;
  for (const Cause& cause : causes) {
    std::string possible = cause.name;
    for (const std::string& other : cause.equivalent) possible += " or " + other;
    names = joined(names, cause.description + " (" + possible + ")");
  }
  return names;
}

void conclude(Explanation* explanation, bool withheld) {
  const bool passed = allPassed(explanation->checks_after);
  if (explanation->causes.empty()) {
    explanation->verdict = passed ? Verdict::none : Verdict::unknown;
  } else {
    explanation->verdict = passed && !withheld ? Verdict::explained : Verdict::partly_explained;
  }
  const std::string names = describedNames(explanation->causes);
  std::string failed;
  for (const Check& check : explanation->checks_after)
    if (!check.passed) failed = joined(failed, check.name);
  if (withheld && passed && !explanation->causes.empty()) {
    explanation->message = partlyNamed(names);
    return;
  }
  const bool ended_early = explanation->termination == Termination::iteration_limit;
  const std::string direction = ofUnclearDirection(explanation->before.nominal_model.delay);
  const bool is_direction_alone = failed == kDirection && !withheld && !ended_early;
  if (failed.find(kDirection) != std::string::npos &&
      !(is_direction_alone && explanation->verdict == Verdict::unknown))
    explanation->warnings.push_back(direction);
  if (explanation->verdict == Verdict::unknown && is_direction_alone)
    explanation->message = direction;
  else if (explanation->verdict == Verdict::unknown && !ended_early &&
           isOfNoiseAlone(explanation->checks_after))
    explanation->message = ofNoiseAlone(failed, withheld);
  else if (explanation->verdict != Verdict::unknown || !(withheld || ended_early))
    explanation->message = messageOf(explanation->verdict, names, failed);
  else
    explanation->message = withheld ? notNamed(failed) : unfinished(failed);
}

void tellOddExperiments(Explanation* explanation) {
  if (!explanation->before.has_odd_experiments || !explanation->causes.empty()) return;
  const bool agrees = explanation->verdict == Verdict::none;
  explanation->message = "not all experiments belong together, as a warning tells. " +
                         std::string(agrees ? "Apart from this: " : "Besides: ") +
                         explanation->message;
  explanation->verdict = Verdict::unknown;
}

}  // namespace uncertainty_identification
