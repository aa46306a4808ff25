#include "explanation/named_causes.h"

#include <algorithm>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {

bool isOfSamples(const Cause& cause) {
  const auto traits = {Trait::quantisation, Trait::held_samples, Trait::output_limit,
                       Trait::feedback};
  return std::any_of(traits.begin(), traits.end(),
                     [&](Trait trait) { return hasTrait(cause.name, trait); });
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

}  // namespace uncertainty_identification
