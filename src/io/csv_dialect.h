#pragma once

#include <optional>
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

  /// Reads a number, whatever the locale of the program, or the state of a switch, as 1 or 0; false
  /// if the cell holds anything else.
  /// Where the comma does not separate, the first number with a point or a comma decides which of
  /// the two is the decimal point of the file. Separators of thousands are passed over once a
  /// number such as 1,234.5 or 1.234.567 has shown which character they are; "1,234" alone could
  /// also be a decimal fraction.
  bool number(const CsvCell& cell, double& value);

  /// Lets a number with separators of thousands and a decimal point settle what these are.
  void learn(const CsvCell& cell);

  /// What to do about a cell that is no number, "; ..."; empty where nothing special is known.
  std::string remedyFor(const CsvCell& cell) const;

  bool hasDecimalComma() const { return point_ == ','; }

  /// The character between thousands; 0: none has been seen.
  char thousands() const { return thousands_; }

 private:
  bool grouped(const CsvCell& cell, double& value);

  char separator_, point_;  // point_ is 0 while it is not known
  char thousands_ = '\0';
};

/// The state of a switch that the cell names: true, false, on or off, in whatever case.
std::optional<bool> switchState(const CsvCell& cell);

/// Whether the cell is a number with a decimal point or comma, and perhaps separated thousands.
bool looksNumeric(const CsvCell& cell);

/// The separator with which most of the `rows` have as many cells as the header; among equals tab,
/// semicolon, comma, blanks in this order.
CsvDialect findDialect(const std::string& header, const std::vector<std::string>& rows);

}  // namespace uncertainty_identification
