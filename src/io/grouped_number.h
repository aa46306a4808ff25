#pragma once

#include <optional>
#include <string>

namespace uncertainty_identification {

/// A number whose digits are divided into thousands: "1,234.5", "1.234,5", "1 234.5", "1'234.5".
struct GroupedNumber {
  char separator = '\0';  ///< of the thousands: comma, point, blank (of any kind) or apostrophe
  char point = '\0';      ///< the decimal point, a point or a comma; 0: a whole number
  int separators = 0;     ///< how many there are, at least one
  double value = 0;

  /// Whether the text could not be a number without separators of thousands. "1,234" could.
  bool isClear() const;
};

/// '0' to '9', in every language of the system.
inline bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Nothing for a text that has no such form; "0.125" has not, because no thousands begin with 0.
std::optional<GroupedNumber> groupedNumber(const std::string& text);

}  // namespace uncertainty_identification
