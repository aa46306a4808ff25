#pragma once

#include <optional>
#include <string>

namespace uncertainty_identification {

/// The name of a column without the unit in brackets at its end: "speed [rad/s]" is "speed" in
/// "rad/s". Without brackets the unit is empty.
struct CsvName {
  std::string base, unit;
};
CsvName splitUnit(const std::string& name);

/// How many of the unit of time are a second: 1000 for "ms"; nothing if it is no unit of time.
std::optional<double> perSecond(const std::string& unit);

/// A well-known name of a time column: `t`, `time`, `timestamp`, `stamp`, `__time`, ..., also with
/// _s, _ms, _us or _ns at its end. `unit` is empty where the name does not tell it. Nothing for any
/// other name.
struct CsvTimeName {
  std::string unit;
};
std::optional<CsvTimeName> timeName(const std::string& name);

}  // namespace uncertainty_identification
