// Judges the default configuration by new plants: for plants of 12 kinds of families, simulated by
// a program of its own (study/), it counts how many of 500 new plants of the same family lie inside
// the 95 % bands, and how often bands that do not hold come without a warning. docs/bounds.md
// explains the bands. scripts/study_defaults builds and runs it; --help lists the options. Exits
// with 1 on gross failure.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "study/arguments.h"
#include "study/score.h"
#include "study/system.h"
#include "uncertainty_identification/enum_names.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification::study {
namespace {

constexpr int kFreshPlants = 500;
constexpr double kPoor = 0.6;  // pointwise coverage that deserves a warning

struct Task {
  Kind kind;
  int experiments;
  std::uint64_t seed;
};

/// What became of a system; copied between processes, so without pointers.
struct Outcome {
  bool refused = false;  ///< the package threw an error or its result had no bounds
  BandScore score;
  bool trusted = true;
  double seconds = 0;  ///< [s] processor time of identification and bounds
  int samples = 0;     ///< per experiment
  char basis[24] = "", text[200] = "";
};

template <std::size_t size>
void copyText(const std::string& from, char (&to)[size]) {
  std::snprintf(to, size, "%s", from.c_str());
}

std::string describe(const Estimate& estimate) {
  const NominalModelEstimate& plant = estimate.nominal_model;
  const auto size = [](const Eigen::VectorXd& values) { return std::to_string(values.size()); };
  std::string text = "nb=" + size(plant.b) + " na=" + size(plant.a) + " nc=" + size(plant.c) +
                     " nd=" + size(plant.d) + " delay=" + std::to_string(plant.delay) +
                     " taps=" + std::to_string(estimate.error_model.options.taps) +
                     " components=" + std::to_string(estimate.error_model.mixture.components()) +
                     " " + toString(estimate.termination);
  for (const std::string& reason : estimate.trust.reasons) text += "; " + reason;
  return text;
}

Outcome judge(const System& system, Configuration configuration) {
  Outcome outcome;
  outcome.samples = system.samples;
  try {
    const std::vector<Experiment> experiments = measure(system);
    const double before = processorSeconds();
    Estimate estimate = Identifier(configuration).identify(experiments);
    estimate.configuration.bounds.grid = excitedFrequencies(system);
    const Bounds bounds = computeBounds(estimate);
    outcome.seconds = processorSeconds() - before;
    outcome.trusted = estimate.trust.trusted;
    const ErrorModelOptions& error_model = estimate.error_model.options;
    copyText(error_model.taps == 0 ? "none" : nameOf(error_model.basis), outcome.basis);
    copyText(describe(estimate), outcome.text);
    outcome.score = score(bounds.frequency, estimate.configuration.bounds.levels,
                          freshResponses(system, kFreshPlants, bounds.frequency.omega));
  } catch (const DataError& error) {
    outcome.refused = true;
    copyText(error.what(), outcome.text);
  }
  return outcome;
}

/// A row of the table: the systems that it is about.
struct Row {
  std::string name;
  int systems = 0, failed = 0, refused = 0, untrusted = 0, silent = 0;
  double pointwise = 0, simultaneous = 0, phase = 0;  ///< sums over the systems with bounds
  std::vector<double> seconds, widths;

  int scored() const { return systems - failed - refused; }

  void add(const std::optional<Outcome>& outcome) {
    ++systems;
    failed += !outcome;
    refused += outcome && outcome->refused;
    if (!outcome || outcome->refused) return;
    untrusted += !outcome->trusted;
    silent += outcome->trusted && outcome->score.pointwise < kPoor;
    pointwise += outcome->score.pointwise;
    simultaneous += outcome->score.simultaneous;
    phase += outcome->score.phase;
    seconds.push_back(outcome->seconds);
    widths.push_back(outcome->score.width);
  }

  void print() const {
    const auto percent = [](double sum, int of) { return of == 0 ? NAN : 100 * sum / of; };
    std::printf("%-16s %7d %6d %7d %9.1f %12.1f %6.1f %9.0f %7.0f %8.2f %6.2f\n", name.c_str(),
                systems, failed, refused, percent(pointwise, scored()),
                percent(simultaneous, scored()), percent(phase, scored()),
                percent(untrusted, scored()), percent(silent, scored()), median(seconds),
                median(widths));
  }
};

void printTable(const std::vector<Task>& tasks,
                const std::vector<std::optional<Outcome>>& outcomes) {
  std::map<int, Row> kinds, counts;
  Row all, expressible;
  all.name = "all";
  expressible.name = "all but kind 12";
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    const int kind = static_cast<int>(tasks[k].kind);
    kinds[kind].name = std::to_string(kind) + " " + title(tasks[k].kind);
    kinds[kind].add(outcomes[k]);
    counts[tasks[k].experiments].name = "M = " + std::to_string(tasks[k].experiments);
    counts[tasks[k].experiments].add(outcomes[k]);
    all.add(outcomes[k]);
    if (tasks[k].kind != Kind::inexpressible) expressible.add(outcomes[k]);
  }
  std::printf("%-16s %7s %6s %7s %9s %12s %6s %9s %7s %8s %6s\n", "", "systems", "failed",
              "refused", "pointwise", "simultaneous", "phase", "untrusted", "silent", "seconds",
              "width");
  for (const auto& [kind, row] : kinds) row.print();
  for (const auto& [count, row] : counts) row.print();
  expressible.print();
  all.print();
}

void printSilent(const std::vector<Task>& tasks,
                 const std::vector<std::optional<Outcome>>& outcomes) {
  std::printf("\nsilent: below %.0f %% without a warning\n", 100 * kPoor);
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    if (!outcomes[k] || outcomes[k]->refused || !outcomes[k]->trusted) continue;
    if (outcomes[k]->score.pointwise >= kPoor) continue;
    std::printf("  kind %2d, seed %3d, M = %3d, N = %4d: %5.1f %%, %s, %s\n",
                static_cast<int>(tasks[k].kind), static_cast<int>(tasks[k].seed),
                tasks[k].experiments, outcomes[k]->samples, 100 * outcomes[k]->score.pointwise,
                outcomes[k]->basis, outcomes[k]->text);
  }
}

void write(const Task& task, const std::optional<Outcome>& outcome, std::ofstream* file) {
  nlohmann::json line = {{"kind", static_cast<int>(task.kind)},
                         {"experiments", task.experiments},
                         {"seed", task.seed},
                         {"failed", !outcome}};
  if (outcome) {
    line["samples"] = outcome->samples;
    line["refused"] = outcome->refused;
    line["text"] = std::string(outcome->text);
  }
  if (outcome && !outcome->refused) {
    line["basis"] = std::string(outcome->basis);
    line["pointwise"] = outcome->score.pointwise;
    line["simultaneous"] = outcome->score.simultaneous;
    line["phase"] = outcome->score.phase;
    line["width"] = outcome->score.width;
    line["trusted"] = outcome->trusted;
    line["seconds"] = outcome->seconds;
  }
  *file << line.dump() << std::endl;
}

/// Seeds outermost, so that a study that runs out of time has tried all kinds.
std::vector<Task> tasksOf(const Arguments& arguments, bool brief) {
  const int systems = static_cast<int>(arguments.number("systems", brief ? 2 : 20));
  const std::vector<int> seeds = arguments.numbers("seeds", "1:" + std::to_string(systems)),
                         kinds = arguments.numbers("kinds", "1:" + std::to_string(kKinds)),
                         counts = arguments.numbers("experiments", brief ? "3,8" : "3,8,30,100");
  std::vector<Task> tasks;
  for (int seed : seeds) {
    for (int kind : kinds) {
      if (kind < 1 || kind > kKinds) throw std::runtime_error("--kinds: 1 to 12");
      // Another number of experiments for each kind: a short study tries all numbers, too.
      const auto turn = static_cast<std::size_t>(seed + kind) % counts.size();
      tasks.push_back({static_cast<Kind>(kind), counts[turn], static_cast<std::uint64_t>(seed)});
    }
  }
  return tasks;
}

/// Failures that need no statistics to be seen.
int verdict(const std::vector<std::optional<Outcome>>& outcomes) {
  Row all;
  for (const std::optional<Outcome>& outcome : outcomes) all.add(outcome);
  const bool good = all.scored() > 0 && all.failed == 0 && all.refused <= 0.1 * all.systems &&
                    all.pointwise >= 0.6 * all.scored() && all.silent <= 0.2 * all.scored();
  std::printf(
      "\n%s: no crash, at most 10 %% refused, mean pointwise coverage at least 60 %%, at "
      "most 20 %% silent\n",
      good ? "passed" : "FAILED");
  return good ? 0 : 1;
}

int study(const Arguments& arguments) {
  const bool brief = arguments.has("short");
  const std::vector<Task> tasks = tasksOf(arguments, brief);
  const Configuration configuration = arguments.configuration();
  const int most_samples = static_cast<int>(arguments.number("most-samples", 30000));
  std::ofstream file(arguments.text("json", "/dev/null"));
  const auto outcomes = runTasks<Outcome>(
      static_cast<int>(tasks.size()), arguments.limits(brief ? 0.9 : 10),
      [&](int k) {
        const Task& task = tasks[static_cast<std::size_t>(k)];
        return judge(drawSystem(task.kind, task.experiments, most_samples, task.seed),
                     configuration);
      },
      [&](int k, const std::optional<Outcome>& outcome) {
        write(tasks[static_cast<std::size_t>(k)], outcome, &file);
      });
  std::printf("%zu of %zu systems in the time; shares in %%; %d new plants each\n", outcomes.size(),
              tasks.size(), kFreshPlants);
  printTable(tasks, outcomes);
  printSilent(tasks, outcomes);
  return verdict(outcomes);
}

}  // namespace
}  // namespace uncertainty_identification::study

int main(int argc, char** argv) {
  using uncertainty_identification::study::Arguments;
  try {
    return uncertainty_identification::study::study(
        Arguments(argc, argv,
                  {{"systems", "systems of each kind (20)"},
                   {"kinds", "kinds of families: 1,2 or 1:12 (all)"},
                   {"seeds", "seeds of the systems, A:B, instead of --systems"},
                   {"experiments", "numbers of experiments that are tried in turn (3,8,30,100)"},
                   {"most-samples", "of all experiments of a system together (30000)"},
                   {"json", "file to which each system's result is written as a line"},
                   {"short", "the quick look of a minute"}},
                  {"short"}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "defaults: %s\n", error.what());
    return 2;
  }
}
