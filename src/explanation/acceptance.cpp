#include "explanation/acceptance.h"

#include <algorithm>
#include <cmath>

namespace uncertainty_identification {
namespace {

constexpr double kNear = 6;        ///< [nats] of score that the data may not tell apart
constexpr double kClearly = 0.95;  ///< ratio of squared errors

}  // namespace

double errorRatio(const Gain& gain) {
  const Comparison& fit = gain.nrmse_fit_percent;
  return std::pow((100 - fit.after) / (100 - fit.before), 2);
}

bool passes(const Gain& gain, AcceptanceRule rule) {
  if (std::isnan(gain.standard_error) || rule == AcceptanceRule::any_gain)
    return gain.log_density > 0;
  const double least_errors = rule == AcceptanceRule::no_significant_loss ? -2 : 1.645;
  return gain.log_density > least_errors * gain.standard_error;
}

bool simulatesAsWell(const Effect& effect, const Gain& gain) {
  constexpr double kHelps = 0.99, kMost = 1.01, kMostByTheta = 1.1;
  constexpr double kAFifth = 0.8, kWell = 80;  // of the variance; [% of fit]
  const bool structural = effect.description().screening == ScreeningKind::regression &&
                          !isOfNoise(effect) && !isOfMixture(effect);
  if (effect.has(Trait::constant)) return errorRatio(gain) < kClearly;
  if (!structural) return errorRatio(gain) <= kMostByTheta;
  const Comparison& noise = gain.noise_variance;
  const bool moves_plant = effect.stage() == Stage::actuator || effect.stage() == Stage::loop;
  const bool must_help = moves_plant && !effect.has(Trait::order) &&
                         noise.after < kAFifth * noise.before &&
                         gain.nrmse_fit_percent.before >= kWell;
  return errorRatio(gain) <= (must_help ? kHelps : kMost);
}

bool stillHolds(const Effect& effect, const Gain& gain) {
  return passes(gain, AcceptanceRule::no_significant_loss) && simulatesAsWell(effect, gain);
}

bool isClear(const Gain& gain) {
  constexpr double kErrors = 3;
  return gain.log_density > kErrors * gain.standard_error || errorRatio(gain) < kClearly;
}

AcceptanceRule acceptanceRule(const Effect& effect, double score) {
  constexpr double kHigh = 15;  // [nats]
  if (isOfMixture(effect)) return AcceptanceRule::no_significant_loss;
  return score > kHigh ? AcceptanceRule::any_gain : AcceptanceRule::significant_gain;
}

bool isDifferencing(const Fit& fit) {
  constexpr double kEdge = 0.05;
  for (std::size_t k = 0; k < fit.model->effects().size(); ++k) {
    const EffectDescription& of = fit.model->effects()[k]->description();
    if (fit.model->effects()[k]->has(Trait::differencing) &&
        fit.model->psi(fit.at.parameters, k)[0] > of.parameters[0].upper - kEdge)
      return true;
  }
  return false;
}

bool mayBeOrder(const FittedEffect& chosen, const std::vector<FittedEffect>& ranked) {
  return chosen.effect->has(Trait::order) ||
         std::any_of(ranked.begin(), ranked.end(), [&](const FittedEffect& other) {
           return other.effect->has(Trait::order) && other.score > chosen.score - kNear;
         });
}

bool isFormOfOneCause(const Effect& one, const Effect& other) {
  return one.name() == other.name() && one.has(Trait::one_cause);
}

std::vector<std::string> equivalentOf(const FittedEffect& chosen,
                                      const std::vector<FittedEffect>& ranked) {
  std::vector<std::string> names = chosen.effect->description().equivalent;
  for (const FittedEffect& other : ranked) {
    if (isFormOfOneCause(*other.effect, *chosen.effect)) continue;
    const bool same = other.effect->name() == chosen.effect->name();
    const std::string name = same ? other.effect->label() : other.effect->name();
    const bool is_new = std::find(names.begin(), names.end(), name) == names.end();
    if (other.effect != chosen.effect && other.score > chosen.score - kNear && is_new)
      names.push_back(name);
  }
  return names;
}

}  // namespace uncertainty_identification
