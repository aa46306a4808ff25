#pragma once

#include <string>
#include <vector>

#include "data_set.h"
#include "summary.h"

/// The parts of the suite: their data sets, and the targets that explain() must reach on them.
namespace uncertainty_identification::suite {

/// Which runs of each data set are tried: `count` of them from the number `first` on.
struct Runs {
  int first = 1, count = 10;
};

/// Options that all tasks of a part share.
struct Scale {
  test::HiddenEffectOptions options;
  int threads = kAutomatic;
  int fresh = 0;
};

/// Tasks that hide each effect on its own.
std::vector<Task> singleTasks(const std::vector<std::string>& effects, Runs runs,
                              const Scale& scale);

/// Tasks that hide nothing.
std::vector<Task> cleanTasks(Runs runs, const Scale& scale);

/// Tasks that hide each effect on its own, and explain it without having it in the catalogue.
std::vector<Task> removedTasks(const std::vector<std::string>& effects, Runs runs,
                               const Scale& scale);

/// Tasks that hide two different effects at once. Pair number 1..count determines which ones. They
/// are drawn from the catalogue without the effects that thirty experiments can hardly show even on
/// their own (exp_mode, plant_aging, exp_feedback), and never from the same equivalence class.
std::vector<Task> pairTasks(int count, Runs runs, const Scale& scale);

/// The same tasks under another name, where explain() chooses the orders itself.
std::vector<Task> withoutOrders(std::vector<Task> tasks);

/// The judge functions compare the outcomes of a part with the targets of the full suite. `right`
/// and `exact` are the shares that are required over all effects, `each` that for every single
/// effect. The latter does not apply to effects that thirty experiments can hardly show, and it
/// counts only the data that can show the effect.
void judgeSingles(const std::vector<Outcome>& outcomes, const std::string& name, double right,
                  double exact, double each, Targets* targets);
void judgeClean(const std::vector<Outcome>& outcomes, double quiet, Targets* targets);
void judgeUnknown(const std::vector<Outcome>& outcomes, const std::string& name, Targets* targets);
void judgePairs(const std::vector<Outcome>& outcomes, Targets* targets);
void judgeParameters(const std::vector<Outcome>& outcomes, Targets* targets);
/// Compares the 90 % intervals of the held-out gain with the gain on the Task::fresh experiments,
/// and that gain with trueGain().
void judgeGains(const std::vector<Outcome>& outcomes, Targets* targets);
void judgeTimes(const std::vector<Outcome>& outcomes, const std::string& name, double most,
                Targets* targets);

}  // namespace uncertainty_identification::suite
