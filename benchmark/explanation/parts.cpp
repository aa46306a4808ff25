#include "parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace uncertainty_identification::suite {
namespace {

const std::vector<std::string> kHardlySeen = {"exp_mode", "plant_aging", "exp_feedback"};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool equivalent(const std::string& left, const std::string& right) {
  return std::any_of(
      equivalenceClasses().begin(), equivalenceClasses().end(),
      [&](const auto& names) { return contains(names, left) && contains(names, right); });
}

Task task(const std::string& part, std::vector<std::string> hidden, int run, const Scale& scale) {
  Task one;
  one.part = part;
  one.hidden = std::move(hidden);
  one.run = run;
  one.options = scale.options;
  one.threads = scale.threads;
  one.fresh = scale.fresh;
  return one;
}

/// Whether the poles and zeros of the declared model imitate the hidden delay or lag so well that
/// even the true extended model gains next to nothing. No method could find the effect then.
bool isAbsorbed(const Outcome& outcome) {
  constexpr double kSeen = 1;  // [nats] per experiment
  return equivalent(outcome.task.hidden.front(), "plant_pole") && outcome.true_gain &&
         *outcome.true_gain < kSeen;
}

std::vector<std::string> drawPair(int number) {
  std::vector<std::string> names;
  for (const std::string& name : test::catalogueEffects()) {
    if (!contains(kHardlySeen, name)) names.push_back(name);
  }
  std::mt19937_64 random(static_cast<std::uint64_t>(number));
  std::uniform_int_distribution<std::size_t> pick(0, names.size() - 1);
  for (;;) {
    const std::string first = names[pick(random)], second = names[pick(random)];
    if (first != second && !equivalent(first, second)) return {first, second};
  }
}

template <class Test>
int count(const std::vector<Outcome>& outcomes, Test test) {
  return static_cast<int>(std::count_if(outcomes.begin(), outcomes.end(), test));
}

}  // namespace

std::vector<Task> singleTasks(const std::vector<std::string>& effects, Runs runs,
                              const Scale& scale) {
  std::vector<Task> tasks;
  for (const std::string& name : effects) {
    for (int run = runs.first; run < runs.first + runs.count; ++run)
      tasks.push_back(task("single", {name}, run, scale));
  }
  return tasks;
}

std::vector<Task> cleanTasks(Runs runs, const Scale& scale) {
  std::vector<Task> tasks;
  for (int run = runs.first; run < runs.first + runs.count; ++run)
    tasks.push_back(task("clean", {}, run, scale));
  return tasks;
}

std::vector<Task> removedTasks(const std::vector<std::string>& effects, Runs runs,
                               const Scale& scale) {
  std::vector<Task> tasks = singleTasks(effects, runs, scale);
  for (Task& each : tasks) {
    each.part = "removed";
    each.removed = true;
  }
  return tasks;
}

std::vector<Task> pairTasks(int count, Runs runs, const Scale& scale) {
  std::vector<Task> tasks;
  for (int number = 1; number <= count; ++number) {
    for (int run = runs.first; run < runs.first + runs.count; ++run)
      tasks.push_back(task("pair", drawPair(number), run, scale));
  }
  return tasks;
}

std::vector<Task> withoutOrders(std::vector<Task> tasks) {
  for (Task& each : tasks) {
    each.part += ", orders auto,";
    each.orders_auto = true;
  }
  return tasks;
}

void judgeSingles(const std::vector<Outcome>& outcomes, const std::string& name, double right,
                  double exact, double each, Targets* targets) {
  const auto all = static_cast<int>(outcomes.size());
  const auto is_right = [](const Outcome& outcome) { return outcome.right(); };
  targets->share(name + ": named", count(outcomes, is_right), all, right);
  targets->share(name + ": exactly the truth",
                 count(outcomes, [](const Outcome& outcome) { return outcome.exact(); }), all,
                 exact);
  std::map<std::string, std::vector<Outcome>> by_name;
  for (const Outcome& outcome : outcomes) {
    if (!isAbsorbed(outcome)) by_name[outcome.task.hidden.front()].push_back(outcome);
  }
  for (const auto& [effect, part] : by_name) {
    if (contains(kHardlySeen, effect)) continue;
    targets->share(name + ": " + effect, count(part, is_right), static_cast<int>(part.size()),
                   each);
  }
}

void judgeClean(const std::vector<Outcome>& outcomes, double quiet, Targets* targets) {
  targets->share("clean data: nothing named, nothing unknown",
                 count(outcomes,
                       [](const Outcome& o) {
                         return o.failure.empty() && o.causes.empty() && !o.raisesUnknown();
                       }),
                 static_cast<int>(outcomes.size()), quiet);
}

void judgeUnknown(const std::vector<Outcome>& outcomes, const std::string& name, Targets* targets) {
  const auto all = static_cast<int>(outcomes.size());
  const auto raised = [](const Outcome& o) { return o.raisesUnknown(); };
  targets->share(name + ": unknown raised", count(outcomes, raised), all, 0.85);
  targets->share(
      name + ": unknown and no structural name",
      count(outcomes, [](const Outcome& o) { return o.raisesUnknown() && !o.namesStructure(); }),
      count(outcomes, raised), 0.5);
}

void judgePairs(const std::vector<Outcome>& outcomes, Targets* targets) {
  const auto all = static_cast<int>(outcomes.size());
  targets->share("pairs: both named", count(outcomes, [](const Outcome& o) { return o.right(); }),
                 all, 0.8);
  targets->share("pairs: at least one named",
                 count(outcomes, [](const Outcome& o) { return o.found() > 0; }), all, 0.97);
}

void judgeParameters(const std::vector<Outcome>& outcomes, Targets* targets) {
  std::vector<double> errors;
  int covered = 0, with_interval = 0;
  for (const Outcome& outcome : outcomes) {
    if (!outcome.exact()) continue;
    for (const RecoveredParameter& each : outcome.parameters) {
      errors.push_back(100 * each.relativeError());
      covered += each.covered.value_or(false) ? 1 : 0;
      with_interval += each.covered ? 1 : 0;
    }
  }
  targets->atMost("parameters: median error [%]", median(errors), 2.5);
  targets->share("parameters: 90 % intervals that hold", covered, with_interval, 0.85);
  targets->share("parameters: 90 % intervals that do not", with_interval - covered, with_interval,
                 0.05);
}

void judgeGains(const std::vector<Outcome>& outcomes, Targets* targets) {
  int covered = 0, measured = 0;
  std::vector<double> shares;
  for (const Outcome& outcome : outcomes) {
    if (!outcome.fresh_gain || !outcome.causes.front().gain) continue;
    const Gain& gain = *outcome.causes.front().gain;
    const double there = outcome.fresh_gain->log_density;
    if (gain.standard_error > 0) {
      ++measured;
      covered += gain.lower_90 <= there && there <= gain.upper_90 ? 1 : 0;
    }
    if (outcome.true_gain) shares.push_back(100 * there / *outcome.true_gain);
  }
  targets->share("gains: 90 % intervals that hold that of fresh experiments", covered, measured,
                 0.85);
  targets->share("gains: 90 % intervals that do not", measured - covered, measured, 0.05);
  targets->atLeast("gains: median share of the true extended model's [%]", median(shares), 95);
}

void judgeTimes(const std::vector<Outcome>& outcomes, const std::string& name, double most,
                Targets* targets) {
  std::vector<double> seconds;
  for (const Outcome& outcome : outcomes) seconds.push_back(outcome.seconds);
  targets->time(name + ": median time [s]", median(seconds), most);
}

}  // namespace uncertainty_identification::suite
