#pragma once

#include <string>
#include <vector>

namespace uncertainty_identification {

/// The rows of one experiment as read from a CSV file. Missing values are NaN.
struct CsvTable {
  std::string id;
  std::vector<double> t, u, y;                  ///< t [s]
  std::vector<std::vector<double>> covariates;  ///< in the order of CsvFile::covariate_names
  std::vector<long> lines;                      ///< line of each row, from 1
  std::string problem;                          ///< why it cannot be used; empty: it can
};

/// The rows of a CSV file by experiment, in order of appearance.
struct CsvFile {
  std::string path;
  std::vector<std::string> covariate_names;
  std::vector<CsvTable> tables;
};

/// Reads and parses the file. Throws FileError when it cannot be read. A faulty row becomes the
/// `problem` of its experiment.
CsvFile parseCsv(const std::string& path);

}  // namespace uncertainty_identification
