#include "own_simulation/examine.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>

#include "own_simulation/describe_change.h"
#include "own_simulation/extension.h"
#include "own_simulation/lacking_curves.h"
#include "own_simulation/linear_surrogate.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr int kUnlimited = 1000000;  ///< runs that cost nothing

std::string percentText(double percent) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %%", percent);
  return text;
}

/// "the input acts through a dead zone (act_deadzone)"; more of them behind a semicolon.
std::string inWords(const SimulationCauses& structure) {
  std::string text;
  for (const SimulationCause& cause : structure.causes)
    text += (text.empty() ? "" : "; ") + cause.description + " (" + cause.what.name + ")";
  return text;
}

std::string inWords(const std::vector<OwnCause>& causes) {
  std::string text;
  for (std::size_t k = 0; k < causes.size(); ++k)
    text += (k == 0                   ? ""
             : k + 1 == causes.size() ? ", and with "
                                      : ", with ") +
            causes[k].description;
  return text;
}

/// What the curves add to the sentence.
std::string structureText(const OwnSimulationFindings& found) {
  const SimulationCauses& structure = found.structure;
  if (structure.causes.empty() || found.has_curve_around) return "";
  return ". It lacks a curve: " + inWords(structure) +
         ", with which the fit of held-out windows rises from " +
         percentText(structure.fit_before) + " to " + percentText(structure.fit_after);
}

std::string nothingText(const OwnSimulationFindings& found) {
  if (found.fit_before > 99.99) return ": nothing is wrong with it";
  if (found.ended_early) return "; no cause was found before the search ended";
  return "; no parameter, gain, offset, time or initial state of it is wrong as far as these data "
         "show";
}

std::string sentenceOf(const OwnSimulationFindings& found) {
  const std::string on =
      found.held_out.empty() ? " of what was held out" : " of runs not used for fitting";
  const std::string text = "Your simulation fits " + percentText(found.fit_before) + on;
  const std::string after = " it fits " + percentText(found.fit_after);
  const std::string changes = inWords(found.causes);
  if (found.has_curve_around)
    return text + ". It lacks a curve: " + inWords(found.structure) + "; with this" +
           (changes.empty() ? "" : ", and with " + changes) + after;
  if (found.causes.empty()) return text + nothingText(found) + structureText(found);
  if (found.curveLeads())
    return text + structureText(found) + ". Without the curve the best would be " + changes + " (" +
           percentText(found.fit_after) + "), which may only stand for it";
  return text + "; with " + changes + after + structureText(found);
}

Eigen::VectorXd comparedPart(const ComparedRun& run, const Eigen::VectorXd& signal) {
  return signal.segment(run.blocks.front(), run.blocks.back() - run.blocks.front());
}

OwnRun pictureOf(const std::string& rank, const ComparedRun& run, const ChangedSimulation& yours,
                 const ChangedSimulation& simulation, const Changes& changes) {
  const Experiment& experiment = *run.experiment;
  OwnRun picture;
  picture.rank = rank;
  picture.id = experiment.id;
  picture.sample_time = experiment.sample_time;
  picture.start = run.blocks.front() * experiment.sample_time;
  picture.measured = comparedPart(run, (run.weight > 0).select(experiment.y, std::nan("")));
  picture.yours = comparedPart(run, yours.output(run, {}));
  Eigen::VectorXd extended = simulation.output(run, changes);
  const Eigen::MatrixXd transient = transientOf(changes, extended.size());
  if (transient.cols() > 0) {
    const Eigen::VectorXd weighted = run.weight.matrix().cwiseProduct(transient.col(0));
    const Eigen::VectorXd error = (run.weight > 0).select(experiment.y - extended, 0.0);
    extended += weighted.dot(error) / std::max(weighted.squaredNorm(), 1e-300) * transient.col(0);
  }
  picture.extended = comparedPart(run, extended);
  const ComparedData alone{{run}};
  picture.fit_yours = alone.fitOf(errorsOf(yours, alone, {}).sum());
  picture.fit_extended = alone.fitOf(errorsOf(simulation, alone, changes).sum());
  return picture;
}

/// The best, the median and the worst run by the error of the user's simulation as it is.
std::vector<OwnRun> picturesOf(const ComparedData& held, const ChangedSimulation& yours,
                               const ChangedSimulation& simulation, const Changes& changes) {
  std::vector<std::pair<double, const ComparedRun*>> order;
  for (const ComparedRun& run : held.runs)
    order.emplace_back(errorsOf(yours, {{run}}, {}).sum(), &run);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& left, const auto& right) { return left.first < right.first; });
  const std::size_t last = order.size() - 1;
  std::vector<OwnRun> pictures{
      pictureOf("median", *order[last / 2].second, yours, simulation, changes)};
  if (last >= 1)
    pictures.push_back(pictureOf("worst", *order[last].second, yours, simulation, changes));
  if (last >= 2)
    pictures.insert(pictures.begin(),
                    pictureOf("best", *order[0].second, yours, simulation, changes));
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

ChangeSearchLimits limitsOf(const ExamineOptions& options, std::string* doing) {
  ChangeSearchLimits limits;
  limits.max_causes = options.max_causes;
  limits.tell = [doing](const std::string& what) { *doing = what; };
  return limits;
}

ComparisonTask taskOf(const Simulation& simulation, const std::vector<Experiment>& fitted,
                      const std::vector<Experiment>& held, const ExamineOptions& options,
                      std::string* doing) {
  ComparisonTask task;
  task.fitted = comparedData(fitted, 0, held.empty() ? kFittedShare : 1);
  task.held = comparedData(held.empty() ? fitted : held, held.empty() ? kFittedShare : 0, 1);
  requireComparable(task.fitted);
  requireComparable(task.held);
  task.limits = limitsOf(options, doing);
  task.most = simulation.canRerun() ? options.max_simulations : kUnlimited;
  if (task.most < task.fewest())
    throw ConfigurationError("simulation.max_simulations: found " + std::to_string(task.most) +
                             "; allowed: at least " + std::to_string(task.fewest()) +
                             ", one run over each experiment");
  task.keep_going = [doing, progress = options.progress](int count) {
    return !progress || progress(*doing + " (" + std::to_string(count) + " runs)");
  };
  return task;
}

/// Causes and corrections.
void tellChanges(const SimulationComparison& best, const ComparisonTask& task,
                 const LinearSurrogate& surrogate, const Simulation& simulation,
                 OwnSimulationFindings* found) {
  const Changes& changes = best.result.fit.changes;
  const double sample_time = task.fitted.runs.front().experiment->sample_time;
  found->causes = describeChanges(best.result, spreadOf(best.changed, task.fitted, changes),
                                  best.changed, task.fitted, task.held, sample_time);
  const bool is_surrogate = surrogate.simulation != nullptr;
  if (is_surrogate) nameBySurrogate(&found->causes);
  found->extension = extensionOf(best.changed, changes, sample_time,
                                 is_surrogate ? *surrogate.linear : simulation, is_surrogate);
}

}  // namespace

bool OwnSimulationFindings::curveLeads() const {
  const double left = 100 - structure.fit_after;
  const auto halves = [left](double fit) { return left * left < 0.5 * (100 - fit) * (100 - fit); };
  return !has_curve_around && !structure.causes.empty() && halves(structure.fit_before) &&
         halves(fit_after);
}

OwnSimulationFindings examine(Simulation& simulation, const std::vector<Experiment>& fitted,
                              const std::vector<Experiment>& held, const ExamineOptions& options) {
  std::string doing = "running your simulation";
  const ComparisonTask task = taskOf(simulation, fitted, held, options, &doing);
  // Without parameters of its own, a linear model of it says what other ones would change.
  LinearSurrogate surrogate;
  if (simulation.parameters().empty()) surrogate = fitSurrogate(simulation, fitted);
  Simulation& compared = surrogate.simulation ? *surrogate.simulation : simulation;
  // Half of the runs are kept for curves: where one is lacking, changes in its place need many.
  const int most = options.structure ? std::max(task.most / 2, task.fewest()) : task.most;
  SimulationComparison own(compared, task, most);
  LackingCurves curves;
  if (options.structure && !own.runs.cancelled())
    curves = searchLackingCurves(compared, own, task, fitted, held, options);
  const bool is_around = curves.around.has_value();
  if (own.runs.endedEarly() && curves.found.causes.empty())
    own.goOn(task, task.most - curves.simulations);
  const SimulationComparison& best = is_around ? *curves.around->comparison : own;

  OwnSimulationFindings found;
  found.simulation = simulation.description();
  found.can_rerun = simulation.canRerun();
  found.structure = std::move(curves.found);
  found.has_curve_around = is_around;
  found.fit_before = task.held.fitOf(own.result.held_before.sum());
  found.fit_after = task.held.fitOf(best.heldError());
  for (const Experiment& each : held) found.held_out.push_back(each.id);
  tellChanges(best, task, surrogate, simulation, &found);
  if (is_around) found.extension.curve = curves.around->curve;
  found.runs = picturesOf(task.held, own.changed, best.changed, best.result.fit.changes);
  found.surrogate_fit = surrogate.fit;
  if (simulation.canRerun()) found.simulations = own.runs.count() + curves.simulations;
  found.ended_early = best.runs.endedEarly() || curves.ended_early;
  found.sentence = sentenceOf(found);
  return found;
}

}  // namespace uncertainty_identification
