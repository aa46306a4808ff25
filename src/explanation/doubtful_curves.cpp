#include "explanation/doubtful_curves.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "data/text.h"
#include "explanation/sample_checks.h"

namespace uncertainty_identification {

std::string namesOf(const SimulationCauses& simulation) {
  std::string names;
  for (const SimulationCause& cause : simulation.causes)
    names += (names.empty() ? "" : ", ") + cause.what.name;
  return names;
}

namespace {

/// Names none of the curves that were found, for this reason.
void refuseCurves(const std::string& why, SimulationCauses* simulation) {
  simulation->refused += (simulation->refused.empty() ? "" : "; ") + why;
  simulation->causes.clear();
  simulation->withheld.clear();
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

/// Mean rate of the deviations of a signal from its mean, per sample; none where it does not move.
std::optional<double> rateOf(const Eigen::VectorXd& signal) {
  const Eigen::ArrayXd deviations = signal.array() - signal.mean();
  const Eigen::Index steps = signal.size() - 1;
  const double changes = (deviations.tail(steps) - deviations.head(steps)).square().sum();
  if (!(changes > 0)) return {};
  return std::sqrt(changes / deviations.square().sum());
}

/// Whether the input's frequency is another at the end of the experiments than at their beginning,
/// as that of a sweep: of all in the same direction.
bool areSweeps(const std::vector<Experiment>& experiments) {
  constexpr double kFar = 2;  // ratio of the rates in the last and the first third
  constexpr int kFewest = 30;
  int faster = 0, slower = 0;
  for (const Experiment& experiment : experiments) {
    const int third = experiment.samples() / 3;
    if (third < kFewest) return false;
    const auto first = rateOf(experiment.u.head(third)), last = rateOf(experiment.u.tail(third));
    if (!first || !last) return false;
    faster += *last > kFar * *first ? 1 : 0;
    slower += *last * kFar < *first ? 1 : 0;
  }
  const auto all = static_cast<int>(experiments.size());
  return all > 0 && (faster == all || slower == all);
}

/// A gain that changes with time and what was found on top of it, where the frequency does as well:
/// dynamics or friction that the model lacks look the same.
void dropTimeGainOfSweeps(const std::vector<Experiment>& fitted, SimulationCauses* simulation) {
  if (simulation->causes.empty() || simulation->causes[0].what.place != "time_gain" ||
      !areSweeps(fitted))
    return;
  refuseCurves(simulation->causes[0].what.name +
                   ": the frequency of the input changes during the experiments as well, so that "
                   "a gain that changes with time cannot be told from one that depends on the "
                   "frequency, as of a pole or friction that the model lacks; excite all "
                   "frequencies at all times",
               simulation);
}

/// All curves that were found beside an oscillation of the linear plant that nothing damps. Windows
/// of any initial state follow such a line of the noise, and what the plant lacks beside it is
/// looked for with a wrong plant: a friction with a limit cycle keeps the line's amplitude.
void dropBesideLine(SimulationCauses* simulation) {
  if (!(simulation->lasting_oscillation > 0)) return;
  simulation->withheld.clear();
  if (simulation->causes.empty()) return;
  refuseCurves(namesOf(*simulation) + ": found beside an oscillation of the linear plant at " +
                   rounded(simulation->lasting_oscillation) +
                   " Hz that does not decay within the records, as of hum; not named",
               simulation);
}

/// Curves with which the simulation is still far from what was measured.
void dropOfPoorSimulation(SimulationCauses* simulation) {
  constexpr double kLeast = 60;  // [%] fit
  if (simulation->causes.empty() || simulation->fit_after >= kLeast) return;
  refuseCurves(namesOf(*simulation) + ": raises the fit of simulating held-out data from " +
                   rounded(simulation->fit_before) + " to " + rounded(simulation->fit_after) +
                   " %, which leaves too much unexplained to tell the cause; not named",
               simulation);
}

}  // namespace

bool takeHalfAway(const SimulationCauses& simulation) {
  constexpr double kHalf = 0.5, kQuarter = 0.25;
  const double before = std::pow(100 - simulation.fit_before, 2),
               after = std::pow(100 - simulation.fit_after, 2);
  const bool tells_noise = simulation.unpredictable_share > 0 && after <= (1 - kQuarter) * before;
  const double noise = tells_noise ? simulation.unpredictable_share * after : 0;
  return after - noise <= kHalf * (before - noise);
}

std::string dropCurvesThatLeaveMost(SimulationCauses* simulation) {
  if (simulation->causes.empty() || takeHalfAway(*simulation)) return "";
  const std::string why =
      namesOf(*simulation) + ": raises the fit of simulating held-out data from " +
      rounded(simulation->fit_before) + " to " + rounded(simulation->fit_after) +
      " % and leaves more than half of the squared error beyond noise, so that it may stand for "
      "something else; not named";
  refuseCurves(why, simulation);
  return why;
}

void dropDoubtfulCurves(const std::vector<Experiment>& fitted, SimulationCauses* simulation) {
  dropPlayOfSensorSteps(fitted, simulation);
  dropTimeGainOfSweeps(fitted, simulation);
  dropBesideLine(simulation);
  dropOfPoorSimulation(simulation);
}

}  // namespace uncertainty_identification
