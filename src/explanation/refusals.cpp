#include "explanation/refusals.h"

#include <algorithm>
#include <sstream>

#include "explanation/acceptance.h"

namespace uncertainty_identification {

bool Refusals::isDue(const FittedEffect& candidate, const Gain& gain,
                     const std::vector<FittedEffect>& ranked) const {
  constexpr double kFar = 6;  // [nats]
  if (!simulatesAsWell(*candidate.effect, gain)) return true;
  // Forms of one effect do not outshine each other.
  const bool outshone = std::any_of(ranked.begin(), ranked.end(), [&](const FittedEffect& other) {
    return other.effect->name() != candidate.effect->name() &&
           other.score > candidate.score + kFar && has(*other.effect);
  });
  return outshone && !isClear(gain);
}

void Refusals::add(const Effect& effect, const Gain& gain) {
  fits_.emplace(effect.label(), gain.nrmse_fit_percent);
}

std::vector<FittedEffect> Refusals::left(std::vector<FittedEffect> ranked) const {
  const auto refused = [&](const FittedEffect& one) { return has(*one.effect); };
  ranked.erase(std::remove_if(ranked.begin(), ranked.end(), refused), ranked.end());
  return ranked;
}

std::vector<std::string> Refusals::warnings(const std::vector<std::string>& causes) const {
  std::vector<std::string> all;
  for (const auto& [label, fit] : fits_) {
    if (std::find(causes.begin(), causes.end(), label) != causes.end()) continue;
    std::ostringstream text;
    text.precision(3);
    text << label << " raises the likelihood, but the simulation of held-out experiments does not "
         << "gain from it (fit " << fit.before << " % before, " << fit.after
         << " % after): it is not named as a cause";
    all.push_back(text.str());
  }
  return all;
}

}  // namespace uncertainty_identification
