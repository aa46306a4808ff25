#pragma once

#include <cstdio>
#include <string>

namespace uncertainty_identification {

/// A number as it appears in messages: short, but with enough digits for a stamp in seconds since
/// 1970.
inline std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.13g", value);
  return buffer;
}

/// A rounded number, where three digits say enough (shares, jitter).
inline std::string rounded(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.3g", value);
  return buffer;
}

/// How a message names an experiment.
inline std::string named(const std::string& id) { return "experiment '" + id + "'"; }

}  // namespace uncertainty_identification
