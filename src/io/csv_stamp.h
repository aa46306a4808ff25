#pragma once

#include <cstdint>
#include <optional>

#include "io/csv_dialect.h"

namespace uncertainty_identification {

/// What a text says about the order of day and month.
enum class DateOrder {
  none,         ///< there is no date, only a time of day
  stated,       ///< by the notation: 2024-05-31, 31.05.2024, 31-May-2024
  day_first,    ///< because the first number cannot be a month: 31/05/2024
  month_first,  ///< because the second number cannot be a month: 05/31/2024
  open          ///< 05/06/2024 is 5 June or 6 May; month and day are then in the order of the text
};

/// A date, a time of day, or both, as a cell of a file states them.
struct CsvStamp {
  DateOrder order = DateOrder::none;
  int year = 0, month = 0, day = 0;
  std::int64_t nanoseconds = 0;     ///< since midnight of the day
  bool is_open = false;             ///< "12:30" without a date: hours or minutes come first
  std::optional<int> zone_minutes;  ///< east of Greenwich; nothing: not stated
};

/// Reads dates with a year of four digits (with points also of two) and times of day, joined by T
/// or blanks, with AM, PM, Z, UTC or an offset such as +02:00 at the end. Nothing for any other
/// text, and for a date that no calendar has.
std::optional<CsvStamp> parseStamp(const CsvCell& cell);

/// [days] from 1 January 1970 to a date of the Gregorian calendar.
std::int64_t daysSince1970(int year, int month, int day);

}  // namespace uncertainty_identification
