#pragma once

#include <sstream>
#include <string>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

/// Throws ConfigurationError "<key>: found <value>; allowed: <allowed>" unless `ok`.
template <class Value>
void require(bool ok, const std::string& key, const Value& value, const std::string& allowed) {
  if (ok) return;
  std::ostringstream message;
  message << key << ": found " << value << "; allowed: " << allowed;
  throw ConfigurationError(message.str());
}

/// Throws ConfigurationError that names key, value and range unless low <= value <= high; NaN is
/// rejected. `otherwise` names a value that is allowed in addition to the range, e.g. "auto".
template <class Value>
void requireRange(const std::string& key, const Value& value, const Value& low, const Value& high,
                  const std::string& otherwise = "") {
  std::ostringstream allowed;
  allowed << low << " to " << high << (otherwise.empty() ? "" : ", or " + otherwise);
  require(value >= low && value <= high, key, value, allowed.str());
}

}  // namespace uncertainty_identification
