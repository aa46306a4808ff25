#include "io/csv_time_names.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace uncertainty_identification {
namespace {

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Names that tell their unit.
const std::map<std::string, std::string> kNamesWithUnit = {{"%time", "ns"},  // rostopic echo -p
                                                           {"rosbagtimestamp", "ns"},
                                                           {"second", "s"},
                                                           {"seconds", "s"},
                                                           {"secs", "s"},
                                                           {"sec", "s"},
                                                           {"millis", "ms"},
                                                           {"millisecond", "ms"},
                                                           {"milliseconds", "ms"},
                                                           {"msec", "ms"},
                                                           {"micros", "us"},
                                                           {"microsecond", "us"},
                                                           {"microseconds", "us"},
                                                           {"usec", "us"}};

const std::set<std::string> kNames = {"t",        "time",          "timestamp",    "time_stamp",
                                      "__time",   "stamp",         "elapsed",      "elapsed_time",
                                      "timer",    "rostime",       "header_stamp", "timestamps",
                                      "sim_time", "sampling_time", "unix_time",    "x-axis",
                                      "tiempo",   "zeit",          "temps",        "tempo"};

}  // namespace

CsvName splitUnit(const std::string& name) {
  if (name.empty() || (name.back() != ']' && name.back() != ')')) return {name, ""};
  const auto open = name.rfind(name.back() == ']' ? '[' : '(');
  if (open == std::string::npos) return {name, ""};
  const auto last = name.find_last_not_of(' ', open == 0 ? 0 : open - 1);
  const std::string base = open == 0 || last == std::string::npos ? "" : name.substr(0, last + 1);
  return {base, name.substr(open + 1, name.size() - open - 2)};
}

std::optional<double> perSecond(const std::string& unit) {
  static const std::map<std::string, double> kUnits = {
      {"s", 1},
      {"sec", 1},
      {"second", 1},
      {"seconds", 1},
      {"ms", 1e3},
      {"msec", 1e3},
      {"millis", 1e3},
      {"milliseconds", 1e3},
      {"us", 1e6},
      {"usec", 1e6},
      {"micros", 1e6},
      {"microseconds", 1e6},
      {"ns", 1e9},
      {"nsec", 1e9},
      {"nanoseconds", 1e9},
      {"\xC2\xB5s", 1e6},
      {"\xCE\xBCs", 1e6},  // the micro sign and the Greek letter
      {"min", 1.0 / 60},
      {"mins", 1.0 / 60},
      {"minute", 1.0 / 60},
      {"minutes", 1.0 / 60},
      {"h", 1.0 / 3600},
      {"hr", 1.0 / 3600},
      {"hrs", 1.0 / 3600},
      {"hour", 1.0 / 3600},
      {"hours", 1.0 / 3600},
      {"d", 1.0 / 86400},
      {"day", 1.0 / 86400},
      {"days", 1.0 / 86400}};
  const auto found = kUnits.find(lowered(unit));
  if (found == kUnits.end()) return std::nullopt;
  return found->second;
}

std::optional<CsvTimeName> timeName(const std::string& name) {
  const CsvName parts = splitUnit(name);
  if (parts.base == "T") return std::nullopt;  // rather a temperature
  const std::string base = lowered(parts.base);
  if (const auto known = kNamesWithUnit.find(base); known != kNamesWithUnit.end())
    return CsvTimeName{known->second};
  if (kNames.count(base) > 0) return CsvTimeName{parts.unit};
  const auto underscore = base.rfind('_');
  if (underscore == std::string::npos || kNames.count(base.substr(0, underscore)) == 0)
    return std::nullopt;
  const std::string suffix = base.substr(underscore + 1);
  const std::optional<double> per_second = perSecond(suffix);
  // t_h and T_min are rather temperatures, of a heater and the least.
  if (!per_second || (*per_second < 1 && underscore < 2)) return std::nullopt;
  return CsvTimeName{suffix};
}

}  // namespace uncertainty_identification
