#include "explanation/named_causes.h"

#include <algorithm>
#include <cmath>

#include "explanation/intervals.h"
#include "explanation/wording.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {

bool isOfSamples(const Cause& cause) {
  if (cause.seen_in_samples) return true;
  const auto traits = {Trait::quantisation, Trait::held_samples, Trait::output_limit,
                       Trait::feedback};
  return std::any_of(traits.begin(), traits.end(),
                     [&](Trait trait) { return hasTrait(cause.name, trait); });
}

bool isStructural(const Cause& cause) {
  return cause.group != "noise" && !isOfSamples(cause) && !hasTrait(cause.name, Trait::outliers);
}

std::string namesOf(const std::vector<Cause>& causes) {
  std::string names;
  for (const Cause& cause : causes) names += (names.empty() ? "" : ", ") + cause.name;
  return names;
}

void forgetModelWithCauses(Explanation* explanation) {
  explanation->after = explanation->before;
  explanation->checks_after = explanation->checks_before;
  explanation->residual_after = explanation->residual_before;
  for (ExperimentPicture& picture : explanation->pictures) {
    picture.simulated_after = picture.simulated_before;
    picture.deviation_after = picture.deviation_before;
  }
}

Cause described(const FoundCause& found, const SearchState& state, bool in_time) {
  const EffectDescription& description = found.effect->description();
  Cause cause;
  cause.name = description.name;
  cause.variant = description.variant;
  cause.group = groupOf(description.name);
  cause.description = description.meaning;
  cause.advice = description.advice;
  cause.confidence = in_time ? found.confidence : std::nan("");
  cause.equivalent = found.equivalent;
  cause.gain = found.gain;
  cause.seen_in_samples = found.score == 0 && !found.effect->has(Trait::feedback);
  cause.parameters = found.parameters.empty() ? parametersOf(state.fit, state.train, found.effect)
                                              : found.parameters;
  return cause;
}

}  // namespace uncertainty_identification
