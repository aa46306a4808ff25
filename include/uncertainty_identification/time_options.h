#pragma once

#include <string>

namespace uncertainty_identification {

enum class TimeUnit {
  automatic,
  seconds,
  milliseconds,
  microseconds,
  nanoseconds,
  minutes,
  hours,
  days,
  index
};

/// The stamps of the rows of a CSV file.
struct TimeOptions {
  std::string column;  ///< empty: the one with a well-known name (docs/data_files.md)
  /// automatic: as the name of the column or a row of units says, otherwise seconds; index: the
  /// column, or without one the row, counts samples
  TimeUnit unit = TimeUnit::automatic;
  double sample_time = 0;  ///< [s] of one count; without column and unit, rows are counted

  /// Whether stamps are counts of samples.
  bool counts() const;
  void validate() const;
};

}  // namespace uncertainty_identification
