#include "own_simulation/examine.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include "own_simulation/change_search.h"
#include "own_simulation/describe_change.h"
#include "own_simulation/linear_surrogate.h"
#include "own_simulation/own_structure.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr double kFittedShare = 2.0 / 3;
constexpr int kUnlimited = 1000000;  ///< runs that cost nothing

std::string percentText(double percent) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %%", percent);
  return text;
}

/// What the structure adds to the sentence.
std::string structureText(const SimulationCauses& structure) {
  std::string text;
  for (const SimulationCause& cause : structure.causes)
    text += (text.empty() ? "" : "; ") + cause.description + " (" + cause.what.name + ")";
  if (text.empty()) return text;
  return ". It lacks a curve: " + text + ", with which the fit of held-out windows rises from " +
         percentText(structure.fit_before) + " to " + percentText(structure.fit_after);
}

std::string sentenceOf(const OwnSimulationFindings& found) {
  const std::string on =
      found.held_out.empty() ? " of what was held out" : " of runs not used for fitting";
  std::string text = "Your simulation fits " + percentText(found.fit_before) + on;
  if (found.causes.empty() && found.fit_before > 99.99) return text + ": nothing is wrong with it";
  if (found.causes.empty()) {
    return text +
           (found.ended_early
                ? "; no cause was found before the search ended"
                : "; no parameter, gain, offset, time or initial state of it is wrong as far "
                  "as these data show");
  }
  for (std::size_t k = 0; k < found.causes.size(); ++k)
    text += (k == 0                         ? "; with "
             : k + 1 == found.causes.size() ? " and "
                                            : ", ") +
            found.causes[k].description;
  return text + " it fits " + percentText(found.fit_after);
}

Eigen::VectorXd comparedPart(const ComparedRun& run, const Eigen::VectorXd& signal) {
  return signal.segment(run.blocks.front(), run.blocks.back() - run.blocks.front());
}

OwnRun pictureOf(const std::string& rank, const ComparedRun& run,
                 const ChangedSimulation& simulation, const Changes& changes) {
  const Experiment& experiment = *run.experiment;
  OwnRun picture;
  picture.rank = rank;
  picture.id = experiment.id;
  picture.sample_time = experiment.sample_time;
  picture.start = run.blocks.front() * experiment.sample_time;
  picture.measured = comparedPart(run, (run.weight > 0).select(experiment.y, std::nan("")));
  picture.yours = comparedPart(run, simulation.output(run, {}));
  Eigen::VectorXd extended = simulation.output(run, changes);
  const Eigen::MatrixXd transient = transientOf(changes, extended.size());
  if (transient.cols() > 0) {
    const Eigen::VectorXd weighted = run.weight.matrix().cwiseProduct(transient.col(0));
    const Eigen::VectorXd error = (run.weight > 0).select(experiment.y - extended, 0.0);
    extended += weighted.dot(error) / std::max(weighted.squaredNorm(), 1e-300) * transient.col(0);
  }
  picture.extended = comparedPart(run, extended);
  const ComparedData alone{{run}};
  picture.fit_yours = alone.fitOf(errorsOf(simulation, alone, {}).sum());
  picture.fit_extended = alone.fitOf(errorsOf(simulation, alone, changes).sum());
  return picture;
}

/// The best, the median and the worst run by the error of the simulation without changes.
std::vector<OwnRun> picturesOf(const ComparedData& held, const ChangedSimulation& simulation,
                               const Changes& changes) {
  std::vector<std::pair<double, const ComparedRun*>> order;
  for (const ComparedRun& run : held.runs)
    order.emplace_back(errorsOf(simulation, {{run}}, {}).sum(), &run);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& left, const auto& right) { return left.first < right.first; });
  const std::size_t last = order.size() - 1;
  std::vector<OwnRun> pictures{pictureOf("median", *order[last / 2].second, simulation, changes)};
  if (last >= 1) pictures.push_back(pictureOf("worst", *order[last].second, simulation, changes));
  if (last >= 2)
    pictures.insert(pictures.begin(), pictureOf("best", *order[0].second, simulation, changes));
  return pictures;
}

/// The parameters of a linear model are not the user's: the cause is called by what they are.
void nameBySurrogate(std::vector<OwnCause>* causes) {
  static const std::map<char, const char*> kNames{{'g', "sim_gain"},
                                                  {'t', "sim_time_constant"},
                                                  {'o', "sim_frequency"},
                                                  {'z', "sim_damping"},
                                                  {'d', "sim_delay"}};
  for (OwnCause& cause : *causes) {
    if (cause.name != "sim_parameter") continue;
    cause.name = kNames.at(cause.parameter.front());
    cause.advice = "look for what sets the " + cause.parameter +
                   " of your simulation, in the model that is fitted to it";
  }
}

void requireComparable(const ComparedData& data) {
  constexpr int kFewest = 20;
  if (data.samples() < kFewest || !(data.power() > 0))
    throw DataError("the simulation cannot be compared: there are " +
                    std::to_string(data.samples()) +
                    " measured samples whose output is not constant; record at least " +
                    std::to_string(kFewest));
}

}  // namespace

OwnSimulationFindings examine(Simulation& simulation, const std::vector<Experiment>& fitted,
                              const std::vector<Experiment>& held, const ExamineOptions& options) {
  const ComparedData data = comparedData(fitted, 0, held.empty() ? kFittedShare : 1);
  const ComparedData kept =
      comparedData(held.empty() ? fitted : held, held.empty() ? kFittedShare : 0, 1);
  requireComparable(data);
  requireComparable(kept);
  std::string doing = "running your simulation";
  // Without parameters of its own, a linear model of it says what other ones would change.
  LinearSurrogate surrogate;
  if (simulation.parameters().empty()) surrogate = fitSurrogate(simulation, fitted);
  Simulation& compared = surrogate.simulation ? *surrogate.simulation : simulation;
  const int most = simulation.canRerun() ? options.max_simulations : kUnlimited;
  SimulationRuns runs(compared, most, [&](int count) {
    return !options.progress || options.progress(doing + " (" + std::to_string(count) + " runs)");
  });
  const ChangedSimulation changed(runs, data);
  ChangeSearchLimits limits;
  limits.max_causes = options.max_causes;
  limits.tell = [&doing](const std::string& what) { doing = what; };
  const ChangeSearchResult result = searchChanges(changed, data, kept, limits);

  OwnSimulationFindings found;
  found.simulation = simulation.description();
  found.can_rerun = simulation.canRerun();
  found.fit_before = kept.fitOf(result.held_before.sum());
  found.fit_after = kept.fitOf(result.held_after.sum());
  for (const Experiment& experiment : held) found.held_out.push_back(experiment.id);
  found.causes = describeChanges(result, spreadOf(changed, data, result.fit.changes), changed, data,
                                 kept, data.runs.front().experiment->sample_time);
  if (surrogate.simulation) nameBySurrogate(&found.causes);
  found.runs = picturesOf(kept, changed, result.fit.changes);
  if (options.structure && !runs.endedEarly())
    found.structure = searchStructure(changed, result.fit.changes, fitted, held, options.max_causes,
                                      options.progress);
  found.surrogate_fit = surrogate.fit;
  found.simulations = simulation.canRerun() ? runs.count() : 0;
  found.ended_early = runs.endedEarly();
  found.sentence = sentenceOf(found) + structureText(found.structure);
  return found;
}

}  // namespace uncertainty_identification
