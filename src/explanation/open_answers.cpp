#include "explanation/open_answers.h"

#include <algorithm>
#include <vector>

#include "explanation/named_causes.h"
#include "explanation/poor_simulation.h"
#include "explanation/prediction_checks.h"
#include "explanation/residual_checks.h"
#include "explanation/verdict.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

/// Whether parameters of the plant differ, as in the model that identify chooses.
bool isOfSpread(const Cause& cause) {
  return hasTrait(cause.name, Trait::by_experiment) && hasTrait(cause.name, Trait::in_mixture);
}

/// Whether a cause describes what else differs between experiments, or a line in the spectrum of
/// the residuals: plants that differ leave both.
bool mayBeDifference(const Cause& cause) {
  return !isOfSpread(cause) &&
         (hasTrait(cause.name, Trait::by_experiment) || hasTrait(cause.name, Trait::spectral_line));
}

/// Whether tests of the plant fail and a named curve of some shape halves the error of simulating
/// held-out data: that of a common linear plant and, where plants or levels differ, that of the
/// model that causes were looked for in.
bool isBeyondLinear(const Explanation& explanation) {
  constexpr double kHalf = 0.5;
  const auto halves = [&](const SimulationCause& cause) {
    const double linear = std::max(cause.fit_before, explanation.held_out_fit.value_or(100));
    return cause.what.shape != "curve" && cause.what.place != "time" &&
           cause.what.place != "covariate" && 100 - cause.fit_after < kHalf * (100 - linear);
  };
  return !isOfNoiseAlone(explanation.checks_before) &&
         std::any_of(explanation.causes.begin(), explanation.causes.end(), [&](const Cause& cause) {
           return cause.simulation && halves(*cause.simulation);
         });
}

}  // namespace

bool leavesModelOpen(const Configuration& asked) {
  return asked.nominal_model.orders_auto && asked.effects.empty() &&
         asked.error_model.basis == BasisKind::automatic;
}

bool isOpen(const Explanation& explanation) {
  const std::vector<Cause>& causes = explanation.causes;
  if (explanation.verdict == Verdict::none) return leavesDifferencesUntold(explanation);
  if (explanation.verdict == Verdict::explained)
    return std::any_of(causes.begin(), causes.end(), mayBeDifference) &&
           std::all_of(causes.begin(), causes.end(), [](const Cause& cause) {
             return isOfSamples(cause) || isOfSpread(cause) || mayBeDifference(cause);
           });
  const std::vector<Check>& checks = explanation.checks_after;
  const auto fails = [](const Check& check) { return !check.passed && check.name == kDirection; };
  const auto is_loop = [](const Cause& cause) { return hasTrait(cause.name, Trait::feedback); };
  const bool is_controlled = std::any_of(checks.begin(), checks.end(), fails) ||
                             std::any_of(causes.begin(), causes.end(), is_loop);
  const bool has_other = causes.empty() || !std::all_of(causes.begin(), causes.end(), isOfSamples);
  return has_other && !is_controlled && !isBeyondLinear(explanation) &&
         (allPassed(checks) || !isOfNoiseAlone(checks));
}

}  // namespace uncertainty_identification
