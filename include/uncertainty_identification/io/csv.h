#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/data/loaded_data.h"

namespace uncertainty_identification {

/// Reads experiments from a text file of columns: a line with their names, then one line per
/// sample. Separated by commas, semicolons, tabs or blanks; where the comma does not separate, it
/// may be the decimal point. Accepted: a byte order mark, CRLF, blank lines, lines that start with
/// #, % or //, quoted cells, a row of units below the names.
///
/// The columns are those that `configuration` names (input, output, covariates, time,
/// experiment.column), otherwise `t` [s] or another well-known name of the time, `u`, `y` and
/// `experiment`; docs/data_files.md has the rules. Unless the input or the output is named, other
/// columns of numbers are covariates. Without a column of experiments the file is one experiment,
/// its id the file's name without folder and extension. Whatever was assumed beyond the names t, u
/// and y is one of the warnings. An empty cell or `nan` in y is a missing sample, in a covariate
/// one that does not change; an empty cell in u means that the input was sampled in other rows.
///
/// Stamps must rise within each experiment. It is divided further by experiment.mode duration and
/// gap, by mode topic if a column has the name of the topic, and otherwise where a logger that
/// writes regularly paused for more than 20 sample times.
///
/// Stamps that lie one to one on a uniform grid (sample_grid.h) become its samples unchanged.
/// Between them, a row that is absent counts as a missing output, and the input keeps its value;
/// jitter above a thousandth of the sample time is stored in Experiment::stamp_offset.
/// Other stamps, gaps above limits.max_missing and rates other than a given sample_time are
/// resampled (recording.h).
///
/// Throws FileError when the file cannot be read or leaves open which columns are meant,
/// ConfigurationError for a configured column that it does not have, and for mode service. A bad
/// experiment (an unreadable cell, stamps that do not rise, no rows, ...) is rejected, with file,
/// line and column in the reason; the others are read.
LoadedData readCsv(const std::string& path, const Configuration& configuration = {});

/// Writes experiments with the columns experiment, t, u, y and all their covariates, 17 significant
/// digits, so that readCsv gives back the same numbers. Missing outputs and absent covariates are
/// empty cells. The file appears complete or not at all (atomic_file.h). Throws FileError when it
/// cannot be written, DataError for an id or a name with a line break.
void writeCsv(const std::string& path, const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
