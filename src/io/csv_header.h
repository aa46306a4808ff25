#pragma once

#include "io/csv_columns.h"
#include "io/csv_dialect.h"
#include "io/csv_lines.h"

namespace uncertainty_identification {

/// Whether a line is blank or a comment: it begins with #, % or //.
bool isCsvRemark(const char* begin, const char* end);

/// What the first lines of a file say about all of it.
struct CsvHead {
  CsvHeader header;
  CsvDialect dialect;
  long first_row = 0;  ///< line from which on rows are read
};

/// Finds the separator, the names and the row of units from the first lines. Passes over remarks
/// and titles, which are lines of a single cell above rows of several, and over a first line
/// "sep=;". A comment directly above rows of numbers that has as many cells
/// names the columns; where nothing does, they are t (rising like a clock) or column1, column2, ...
/// Throws FileError for an empty file.
CsvHead readHead(const std::string& path, CsvLines& lines);

}  // namespace uncertainty_identification
