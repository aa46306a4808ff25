#include "summary.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "io/text_table.h"
#include "io/truth_yaml.h"

namespace uncertainty_identification::suite {
namespace {

using nlohmann::json;

std::string percent(int part, int all) {
  char text[64];
  std::snprintf(text, sizeof text, "%d/%d (%.1f %%)", part, all, all > 0 ? 100.0 * part / all : 0);
  return text;
}

/// The names of the hidden effects, for example "act_delay + sens_hum".
std::string rowName(const Outcome& outcome) {
  std::string name;
  for (const std::string& each : outcome.task.hidden) name += (name.empty() ? "" : " + ") + each;
  return name.empty() ? "nothing" : name;
}

/// For example "act_delay 2, sens_lag 1".
std::string counted(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [name, count] : counts)
    text += (text.empty() ? "" : ", ") + name + " " + std::to_string(count);
  return text;
}

/// The counts of printConfusion() for one line.
struct Row {
  int all = 0, right = 0, exact = 0, unknown = 0;
  std::vector<double> seconds;
  std::map<std::string, int> others;

  void add(const Outcome& outcome) {
    ++all;
    right += outcome.right() ? 1 : 0;
    exact += outcome.exact() ? 1 : 0;
    unknown += outcome.raisesUnknown() ? 1 : 0;
    seconds.push_back(outcome.seconds);
    if (!outcome.failure.empty()) ++others["(error)"];
    for (const Cause& cause : outcome.causes) {
      const auto& hidden = outcome.task.hidden;
      if (std::find(hidden.begin(), hidden.end(), cause.name) == hidden.end()) ++others[cause.name];
    }
  }

  std::vector<std::string> cells(const std::string& name) const {
    return {name,
            std::to_string(all),
            std::to_string(right),
            std::to_string(exact),
            std::to_string(unknown),
            numberText(std::round(100 * median(seconds)) / 100),
            counted(others)};
  }
};

json parametersOf(const Outcome& outcome) {
  json all = json::array();
  for (const RecoveredParameter& each : outcome.parameters) {
    all.push_back({{"effect", each.effect},
                   {"name", each.name},
                   {"truth", each.truth},
                   {"estimate", each.estimate},
                   {"covered", each.covered ? json(*each.covered) : json()}});
  }
  return all;
}

json gainOf(const Gain& gain) {
  return {{"value", gain.log_density}, {"standard_error", gain.standard_error}};
}

json causesOf(const Outcome& outcome) {
  json all = json::array();
  for (const Cause& cause : outcome.causes) {
    json entry{{"name", cause.name},
               {"variant", cause.variant},
               {"confidence", cause.confidence},
               {"equivalent", cause.equivalent}};
    if (cause.gain) entry["gain"] = gainOf(*cause.gain);
    all.push_back(entry);
  }
  return all;
}

}  // namespace

void Targets::add(const std::string& what, const std::string& found, const std::string& wanted,
                  bool met) {
  if (!met) ++missed_;
  char line[256];
  std::snprintf(line, sizeof line, "%-7s %-62s %-18s %s\n", met ? "met" : "MISSED", what.c_str(),
                found.c_str(), wanted.c_str());
  lines_ += line;
}

void Targets::share(const std::string& what, int good, int all, double least) {
  if (all == 0) return;
  bool met = good >= least * all - 1e-9;
  if (short_form_ && !met) {
    const boost::math::binomial_distribution<double> required(all, least);
    met = boost::math::cdf(required, good) >= 0.01;
  }
  char wanted[32];
  std::snprintf(wanted, sizeof wanted, "at least %.1f %%", 100 * least);
  add(what, percent(good, all), wanted, met);
}

void Targets::atMost(const std::string& what, double value, double most) {
  if (!std::isnan(value))
    add(what, numberText(value), "at most " + numberText(most), value <= most);
}

void Targets::atLeast(const std::string& what, double value, double least) {
  if (!std::isnan(value))
    add(what, numberText(value), "at least " + numberText(least), value >= least);
}

void Targets::time(const std::string& what, double seconds, double most) {
  atMost(what, seconds, short_form_ ? 10 * most : most);
}

int Targets::report() const {
  std::printf("\n%s%s\n", lines_.c_str(), missed_ == 0 ? "passed" : "FAILED");
  return missed_ == 0 ? 0 : 1;
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void printConfusion(const std::vector<Outcome>& outcomes) {
  std::map<std::string, Row> rows;
  for (const Outcome& outcome : outcomes) rows[rowName(outcome)].add(outcome);
  std::vector<std::vector<std::string>> cells = {
      {"hidden", "sets", "right", "exact", "unknown", "median s", "named otherwise"}};
  for (const auto& [name, row] : rows) cells.push_back(row.cells(name));
  std::printf("%s", textTable(cells).c_str());
}

void printParameters(const std::vector<Outcome>& outcomes) {
  std::map<std::string, std::vector<RecoveredParameter>> by_name;
  for (const Outcome& outcome : outcomes) {
    if (!outcome.exact()) continue;
    for (const RecoveredParameter& each : outcome.parameters)
      by_name[each.effect + "." + each.name].push_back(each);
  }
  std::vector<std::vector<std::string>> cells = {
      {"parameter", "sets", "median error [%]", "in 90 % interval"}};
  for (const auto& [name, all] : by_name) {
    std::vector<double> errors;
    int covered = 0, with_interval = 0;
    for (const RecoveredParameter& each : all) {
      errors.push_back(100 * each.relativeError());
      covered += each.covered.value_or(false) ? 1 : 0;
      with_interval += each.covered ? 1 : 0;
    }
    cells.push_back({name, std::to_string(all.size()), numberText(median(errors)),
                     percent(covered, with_interval)});
  }
  std::printf("%s", textTable(cells).c_str());
}

json toJson(const std::vector<Outcome>& outcomes) {
  json all = json::array();
  for (const Outcome& outcome : outcomes) {
    all.push_back({{"part", outcome.task.part},
                   {"hidden", outcome.task.hidden},
                   {"run", outcome.task.run},
                   {"effects", toJson(outcome.hidden.truth)["effects"]},
                   {"strengths", outcome.hidden.strengths},
                   {"redraws", outcome.hidden.redraws},
                   {"verdict", nameOf(outcome.verdict)},
                   {"causes", causesOf(outcome)},
                   {"parameters", parametersOf(outcome)},
                   {"right", outcome.right()},
                   {"exact", outcome.exact()},
                   {"fresh_gain", outcome.fresh_gain ? gainOf(*outcome.fresh_gain) : json()},
                   {"true_gain", outcome.true_gain ? json(*outcome.true_gain) : json()},
                   {"failure", outcome.failure},
                   {"seconds", outcome.seconds}});
  }
  return all;
}

}  // namespace uncertainty_identification::suite
