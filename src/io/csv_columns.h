#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// What stands above the numbers of a CSV file.
struct CsvHeader {
  std::string path;
  long titles = 0;                 ///< lines above the table, of a single cell each
  long line = 0;                   ///< of the names, from 1; 0: none, the names are invented
  std::vector<std::string> names;  ///< of the columns; one without a name is empty
  std::vector<std::string> units;  ///< of the row below the names, without brackets; empty: none
  std::vector<bool> is_text;       ///< the first rows hold texts in this column and no number
  std::vector<bool> is_stamp;      ///< most of them hold a date or a time of day
};

/// A column that is read, and the linear map to what is stored.
struct CsvSignal {
  static constexpr std::size_t kAbsent = std::numeric_limits<std::size_t>::max();

  std::size_t column = kAbsent;
  std::string name = {};  ///< under which it is stored
  double scale = 1, offset = 0;
};

/// Which columns of a file are read, and as what.
struct CsvColumns {
  std::size_t experiment = CsvSignal::kAbsent;  ///< names the experiment of each row
  std::size_t marker = CsvSignal::kAbsent;      ///< mode topic: whether an experiment runs
  std::size_t time = CsvSignal::kAbsent;        ///< absent: the rows are counted
  double per_second = 1;                        ///< what a second is in the time column
  bool unit_is_assumed = false;                 ///< nothing says that these are seconds
  bool has_dates = false;                       ///< the time column holds dates or times of day
  CsvSignal input, output;
  std::vector<CsvSignal> covariates;
  std::vector<std::string> remarks;  ///< what was assumed beyond the names t, u and y
};

/// Chooses by the configuration and otherwise by names; docs/data_files.md states the rules.
/// Throws ConfigurationError for a configured column that the file does not have, FileError where
/// the names leave open which column is meant, both with the names of the columns.
CsvColumns chooseColumns(const CsvHeader& header, const Configuration& configuration);

}  // namespace uncertainty_identification
