#include "explanation/poor_simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "data/text.h"
#include "explanation/named_causes.h"
#include "explanation/residual_checks.h"
#include "explanation/verdict.h"
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
  if (explanation.simulation.skipped.empty()) simulated.fit = explanation.simulation.fit_after;
  for (const Cause& cause : explanation.causes) {
    if (!cause.gain || !std::isfinite(cause.gain->nrmse_fit_percent.after)) continue;
    simulated.fit = cause.gain->nrmse_fit_percent.after;
    simulated.coverage = cause.gain->coverage_95.after;
  }
  return simulated;
}

/// Whether a plant of its own for each of a few experiments is what simulates well. One for all
/// does not, and so few experiments do not show that plants differ by chance.
bool isOfFewPlants(const Explanation& explanation, double fit) {
  constexpr int kFew = 8;  // experiments
  const SimulationCauses& simulation = explanation.simulation;
  return simulation.skipped.empty() && explanation.before.experiment_count < kFew &&
         explanation.before.error_model.mixture.components() > 0 && !explanation.causes.empty() &&
         fit > simulation.fit_before + kFar;
}

/// What the tests do not see: most of the output, or what another linear model simulates, or how
/// uncertain the simulation is, or why experiments differ. Empty where it is none of them.
std::string shortcoming(const Explanation& explanation, const Simulated& simulated) {
  constexpr double kPoor = 50;          // [%] fit
  constexpr double kFewCovered = 0.75;  // of the samples
  const double linear = explanation.simulation.fit_before;
  const bool is_behind = simulated.fit < linear - kFar;
  if (simulated.coverage < kFewCovered)
    return "the 95 % intervals of the simulation hold " + rounded(100 * simulated.coverage) +
           " % of the samples only: the model does not know how far its simulation is off";
  std::ostringstream text;
  text.precision(2);
  if (isOfFewPlants(explanation, simulated.fit)) {
    text << "one plant for all experiments simulates " << linear << " % only, and "
         << explanation.before.experiment_count
         << " experiments do not show whether plants differ by chance or with the input";
    return text.str();
  }
  if (!(simulated.fit < kPoor) && !is_behind) return "";
  text << "the simulation fits held-out data by " << simulated.fit << " % only: ";
  if (is_behind)
    text << "a linear model fitted to its simulation reaches " << linear
         << " %, so the noise model describes what this one lacks";
  else
    text << "the input explains little of the output, the noise model describes the rest";
  text << ", and the tests cannot see what the simulation lacks";
  return text.str();
}

/// Whether what a simulation lacks looks like this cause.
bool isOfResiduals(const Cause& cause) {
  return cause.group == "noise" || hasTrait(cause.name, Trait::outliers);
}

/// Withdraws what was found in the residuals of a simulation that lacks much. What the samples show
/// stays, but explains no part of a simulation that is worse than a constant.
void withdraw(const std::string& lacks, bool is_worse_than_constant, Explanation* explanation) {
  std::vector<Cause>& causes = explanation->causes;
  const auto first = std::stable_partition(causes.begin(), causes.end(), [&](const Cause& cause) {
    return !isOfResiduals(cause) &&
           !(is_worse_than_constant && hasTrait(cause.name, Trait::quantisation));
  });
  const std::vector<Cause> withdrawn(first, causes.end());
  causes.erase(first, causes.end());
  if (!withdrawn.empty())
    explanation->warnings.push_back(namesOf(withdrawn) + ": describes residuals, but " + lacks +
                                    "; not named");
  if (causes.empty()) forgetModelWithCauses(explanation);
  explanation->verdict = causes.empty() ? Verdict::unknown : Verdict::partly_explained;
  explanation->message = causes.empty()
                             ? "something is wrong that is not named: " + lacks
                             : describedNames(causes) + ": seen in the samples, but " + lacks;
}

}  // namespace

void warnOfPoorSimulation(Explanation* explanation) {
  std::vector<Cause>& causes = explanation->causes;
  const bool is_aside = std::all_of(causes.begin(), causes.end(), [](const Cause& cause) {
    return isOfSamples(cause) || isOfResiduals(cause);
  });
  if (explanation->verdict == Verdict::unknown) return;
  if (explanation->verdict == Verdict::partly_explained && !is_aside) return;
  const Simulated simulated = simulatedBy(*explanation);
  const std::string lacks = shortcoming(*explanation, simulated);
  if (!lacks.empty() && !is_aside) explanation->warnings.push_back(lacks);
  if (causes.empty() && !lacks.empty()) {
    if (simulated.fit < 0) explanation->verdict = Verdict::unknown;
    explanation->message = "the checks of the residuals find nothing wrong, but " + lacks;
  }
  if (causes.empty() || !is_aside) return;
  if (!lacks.empty())
    withdraw(lacks, simulated.fit < 0, explanation);
  else if (std::isfinite(simulated.fit) && explanation->verdict == Verdict::explained)
    explanation->message += ". The simulation is the same with it and fits " +
                            std::string(explanation->held_out.empty() ? "" : "held-out ") +
                            "data by " + rounded(simulated.fit) + " %";
}

}  // namespace uncertainty_identification
