#include "explanation/doubtful_curves.h"

#include <string>
#include <utility>

#include "data/text.h"
#include "explanation/sample_checks.h"

namespace uncertainty_identification {
namespace {

/// Names none of the curves that were found, for this reason.
void refuseCurves(const std::string& why, SimulationCauses* simulation) {
  simulation->refused = why;
  simulation->causes.clear();
  simulation->fit_after = simulation->fit_before;
  for (SimulatedWindow& window : simulation->pictures) window.after = window.before;
}

/// A play of the output, if it is the only cause, that is hardly wider than the steps in which the
/// sensor of these experiments reads: the two simulate alike.
void dropPlayOfSensorSteps(const std::vector<Experiment>& fitted, SimulationCauses* simulation) {
  constexpr double kHardlyWider = 1.5;  // half widths, in steps
  if (simulation->causes.size() != 1 || simulation->causes[0].what.shape != "output_play") return;
  const double half_width = simulation->causes[0].values.at(0).value;
  for (const SpoiltSamples& spoilt : checkSamples(withoutRest(fitted))) {
    if (spoilt.trait != Trait::quantisation) continue;
    const double step = spoilt.parameters.front().value;
    if (half_width >= kHardlyWider * step) continue;
    return refuseCurves(simulation->causes[0].what.name + ": a play of half width " +
                            rounded(half_width) + " is hardly wider than the steps of " +
                            rounded(step) + " in which the sensor reads, and simulates as these do",
                        simulation);
  }
}

/// Curves with which the simulation is still far from what was measured.
void dropOfPoorSimulation(SimulationCauses* simulation) {
  constexpr double kLeast = 60;  // [%] fit
  if (simulation->causes.empty() || simulation->fit_after >= kLeast) return;
  std::string names;
  for (const SimulationCause& cause : simulation->causes)
    names += (names.empty() ? "" : ", ") + cause.what.name;
  refuseCurves(names + ": raises the fit of simulating held-out data from " +
                   rounded(simulation->fit_before) + " to " + rounded(simulation->fit_after) +
                   " %, which leaves too much unexplained to tell the cause; not named",
               simulation);
}

}  // namespace

void dropDoubtfulCurves(const std::vector<Experiment>& fitted, SimulationCauses* simulation) {
  dropPlayOfSensorSteps(fitted, simulation);
  dropOfPoorSimulation(simulation);
}

}  // namespace uncertainty_identification
