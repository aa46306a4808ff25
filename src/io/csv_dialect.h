#pragma once

#include <string>
#include <vector>

namespace uncertainty_identification {

/// One cell of a line, without the blanks and quotes around it.
struct CsvCell {
  const char* begin = nullptr;
  const char* end = nullptr;
  bool quoted = false;

  bool empty() const { return begin == end; }
  std::string str() const;
};

/// A piece of a line without the blanks and quotes around it.
CsvCell trimmedCell(const char* begin, const char* end);

/// How lines are divided into cells, and how numbers are written.
class CsvDialect {
 public:
  /// `separator`: comma, semicolon or tab; blank: any run of blanks and tabs.
  explicit CsvDialect(char separator = ',')
      : separator_(separator), point_(separator == ',' ? '.' : '\0') {}

  char separator() const { return separator_; }

  /// Splits a line at its separators, except inside quotes.
  void split(const char* begin, const char* end, std::vector<CsvCell>& cells) const;
  std::vector<CsvCell> split(const std::string& line) const;

  /// Reads a number, whatever the locale of the program; false if the cell holds anything else.
  /// Where the comma does not separate, the first number with a point or a comma decides which of
  /// the two is the decimal point of the file, and the other is no part of a number any more.
  bool number(const CsvCell& cell, double& value);

  bool hasDecimalComma() const { return point_ == ','; }

 private:
  char separator_, point_;  // point_ is 0 while it is not known
};

/// Whether the cell is a number with a decimal point or comma.
bool looksNumeric(const CsvCell& cell);

/// The separator with which most of the `rows` have as many cells as the header; among equals tab,
/// semicolon, comma, blanks in this order.
CsvDialect findDialect(const std::string& header, const std::vector<std::string>& rows);

}  // namespace uncertainty_identification
