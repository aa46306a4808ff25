#include "explanation/unconfirmed_causes.h"

#include <algorithm>
#include <string>
#include <vector>

#include "curves/curve_words.h"
#include "explanation/acceptance.h"
#include "explanation/named_causes.h"
#include "explanation/verdict.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

bool isAmong(const std::vector<std::string>& names, const Cause& cause) {
  return std::find(names.begin(), names.end(), cause.name) != names.end();
}

/// Drops the causes that `is_doubtful` tells, with a warning that says why.
template <typename Doubt>
void drop(const Doubt& is_doubtful, const std::string& why, Explanation* explanation) {
  std::vector<Cause>& causes = explanation->causes;
  const auto first = std::stable_partition(causes.begin(), causes.end(),
                                           [&](const Cause& cause) { return !is_doubtful(cause); });
  if (first == causes.end()) return;
  const std::vector<Cause> dropped(first, causes.end());
  causes.erase(first, causes.end());
  explanation->warnings.push_back(namesOf(dropped) + why);
  if (causes.empty()) forgetModelWithCauses(explanation);
  conclude(explanation, true);
}

}  // namespace

void dropUnconfirmed(Explanation* explanation) {
  constexpr double kUseful = 50;  // [%] fit; below it identify does not trust a model
  const bool plant_fails = !isOfNoiseAlone(explanation->checks_after);
  const auto is_unconfirmed = [&](const Cause& cause) {
    if (isOfSamples(cause) || !cause.gain) return false;
    const bool useful = cause.gain->nrmse_fit_percent.after >= kUseful;
    const bool simulates = useful && isClear(*cause.gain);
    const bool is_spread = hasTrait(cause.name, Trait::in_mixture);  // whose mean is the same plant
    const bool gains_nothing =
        plant_fails && isStructural(cause) && !is_spread && !(errorRatio(*cause.gain) < 1);
    return gains_nothing ||
           (!simulates && ((useful && isCurveCause(cause.name)) || !(cause.gain->lower_90 > 0)));
  };
  drop(is_unconfirmed,
       ": raises the likelihood, but neither held-out data nor a useful simulation confirm it, and "
       "tests still fail; not named",
       explanation);
}

void dropBesideWithheld(Explanation* explanation) {
  const std::vector<std::string>& withheld = explanation->simulation.withheld;
  if (withheld.empty()) return;
  const auto is_elsewhere = [&](const Cause& cause) {
    return isCurveCause(cause.name) && !isOfSamples(cause) && !isAmong(withheld, cause);
  };
  drop(is_elsewhere,
       ": found by the likelihood, and tests still fail; the free simulation shows " +
           withheld.front() + " in its place, so that it may only resemble that; not named",
       explanation);
}

void dropNotShown(Explanation* explanation) {
  const std::vector<std::string>& withheld = explanation->simulation.withheld;
  if (!withheld.empty() && isOfNoiseAlone(explanation->checks_after)) return;
  const auto is_not_shown = [&](const Cause& cause) {
    return isCurveCause(cause.name) && !isOfSamples(cause) &&
           !hasTrait(cause.name, Trait::by_experiment) && !isAmong(withheld, cause);
  };
  drop(is_not_shown,
       ": raises the likelihood, but the free simulation, which looks for the same curve in the "
       "same place, does not show it, and tests still fail; not named",
       explanation);
}

}  // namespace uncertainty_identification
