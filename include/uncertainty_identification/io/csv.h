#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/data/loaded_data.h"

namespace uncertainty_identification {

/// How rows with stamps become experiments.
struct CsvOptions {
  double sample_time = 0;  ///< [s]; 0: that of each experiment's stamps
  ResamplingOptions resampling;
  LimitOptions limits;
};

/// Reads experiments from a text file of comma-separated values: a header line, then one line per
/// sample. Columns, in any order: `t` [s], `u`, `y`, and optionally `experiment`; any other is a
/// covariate. Without `experiment` the file is one experiment, its id the file's name without
/// folder and extension. Accepted: a byte order mark, CRLF, blank lines, lines that start with #,
/// quoted cells. An empty cell or `nan` in y is a missing sample, in a covariate one that does not
/// change; other cells must be numbers.
///
/// Stamps must rise within each experiment. Those that lie one to one on a uniform grid
/// (sample_grid.h) become its samples unchanged. Between them, a row that is absent counts as a
/// missing output, and the input keeps its value; jitter above a thousandth of the sample time is
/// stored in Experiment::stamp_offset.
/// Other stamps, gaps above limits.max_missing and rates other than a given sample_time are
/// resampled (recording.h).
///
/// Throws FileError when the file cannot be read or the header lacks a column. A bad experiment (an
/// unreadable cell, stamps that do not rise, no rows, ...) is rejected, with file, line and column
/// in the reason; the others are read.
LoadedData readCsv(const std::string& path, const CsvOptions& options = {});

/// Writes experiments with the columns experiment, t, u, y and all their covariates, 17 significant
/// digits, so that readCsv gives back the same numbers. Missing outputs and absent covariates are
/// empty cells. The file appears complete or not at all (atomic_file.h). Throws FileError when it
/// cannot be written, DataError for an id or a name with a line break.
void writeCsv(const std::string& path, const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
