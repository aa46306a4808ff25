#pragma once

#include <cmath>
#include <string>

#include "configuration/require.h"

/// Ranges that many keys of a truth share.
namespace uncertainty_identification {

inline void requireFinite(const std::string& key, double value) {
  require(std::isfinite(value), key, value, "a finite number");
}

inline void requirePositive(const std::string& key, double value) {
  require(value > 0 && std::isfinite(value), key, value, "a finite number above 0");
}

inline void requireNotNegative(const std::string& key, double value) {
  require(value >= 0 && std::isfinite(value), key, value, "a finite number, 0 or above");
}

inline void requireProbability(const std::string& key, double value) {
  require(value >= 0 && value < 1, key, value, "at least 0 and below 1");
}

/// A pole or radius of a discrete-time system.
inline void requireInsideCircle(const std::string& key, double value) {
  require(std::abs(value) < 1, key, value, "between -1 and 1, which are excluded");
}

}  // namespace uncertainty_identification
