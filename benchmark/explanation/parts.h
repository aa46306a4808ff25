#pragma once

#include <string>
#include <vector>

#include "data_set.h"
#include "summary.h"

/// The parts of the suite: which data sets, and what must be reached on them.
namespace uncertainty_identification::suite {

/// Runs first, first + 1, ... of each data set.
struct Runs {
  int first = 1, count = 10;
};

/// What is common to the tasks of a part.
struct Scale {
  test::HiddenEffectOptions options;
  int threads = kAutomatic;
  int fresh = 0;
};

/// Each effect alone.
std::vector<Task> singleTasks(const std::vector<std::string>& effects, Runs runs,
                              const Scale& scale);

/// Nothing hidden.
std::vector<Task> cleanTasks(Runs runs, const Scale& scale);

/// Each effect alone, and not in the catalogue with which it is explained.
std::vector<Task> removedTasks(const std::vector<std::string>& effects, Runs runs,
                               const Scale& scale);

/// Two different effects at once, pairs 1..count, each drawn by its number alone: from the whole
/// catalogue but those that 30 experiments can hardly show even alone (exp_mode, plant_aging,
/// exp_feedback), never two of one equivalence class.
std::vector<Task> pairTasks(int count, Runs runs, const Scale& scale);

/// The tasks under another name, orders not told.
std::vector<Task> withoutOrders(std::vector<Task> tasks);

/// Judge the outcomes of a part by what a full suite must reach. `each` effect must reach its
/// share, but for those that thirty experiments can hardly show, and on the data that can show it.
void judgeSingles(const std::vector<Outcome>& outcomes, const std::string& name, double right,
                  double exact, double each, Targets* targets);
void judgeClean(const std::vector<Outcome>& outcomes, double quiet, Targets* targets);
void judgeUnknown(const std::vector<Outcome>& outcomes, const std::string& name, Targets* targets);
void judgePairs(const std::vector<Outcome>& outcomes, Targets* targets);
void judgeParameters(const std::vector<Outcome>& outcomes, Targets* targets);
/// 90 % intervals of the held-out gain against the gain on Task::fresh others, and that against
/// what the true extended model gains there.
void judgeGains(const std::vector<Outcome>& outcomes, Targets* targets);
void judgeTimes(const std::vector<Outcome>& outcomes, const std::string& name, double most,
                Targets* targets);

}  // namespace uncertainty_identification::suite
