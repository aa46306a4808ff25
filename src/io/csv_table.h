#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// The rows of one experiment as read from a CSV file. Missing values are NaN.
struct CsvTable {
  std::string id;
  std::vector<double> t, u, y;                  ///< t [s], strictly rising unless `problem` is set
  std::vector<std::vector<double>> covariates;  ///< in the order of CsvFile::covariate_names
  std::vector<std::int8_t>
      markers;                  ///< mode topic: 1 running, 0 not, -1 not said; empty: no column
  long rows_without_input = 0;  ///< the input was sampled in other rows only
  long empty_outputs = 0;       ///< rows without an output
  long bad_outputs = 0;         ///< rows whose output is NaN or infinite; `y` is NaN there
  double start = 0;             ///< [s] what `t` begins at, where the stamps are dates
  long first_line = 1;          ///< line of the first row, from 1
  std::string problem;          ///< why it cannot be used; empty: it can
};

/// The rows of a CSV file by experiment, in order of appearance.
struct CsvFile {
  std::string path;
  std::string time_name;         ///< of the column; empty: the rows were counted
  bool unit_is_assumed = false;  ///< nothing says that it is in seconds
  bool has_experiments = false;  ///< a column names them
  std::vector<std::string> covariate_names;
  std::vector<CsvTable> tables;
  std::vector<std::string> remarks;  ///< what was assumed about the file
};

/// Reads and parses the file. Throws FileError when it cannot be read or its header leaves open
/// which columns are meant, ConfigurationError for a configured column that it does not have. A
/// faulty row, or a stamp that does not rise, becomes the `problem` of its experiment.
CsvFile parseCsv(const std::string& path, const Configuration& configuration);

}  // namespace uncertainty_identification
