#include "io/csv_dialect.h"

#include <locale.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "io/grouped_number.h"

namespace uncertainty_identification {
namespace {

bool isBlank(char character) { return character == ' ' || character == '\t' || character == '\r'; }

/// Reads a sign, digits and a point of at most 15 digits. Digits and power of ten are then exact
/// doubles, so that their quotient is the double nearest to the number, as with strtod.
bool shortNumber(const CsvCell& cell, char point, double& value) {
  static constexpr double kPowers[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                       1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const char* at = cell.begin;
  if (cell.end - at > 17) return false;
  const bool negative = *at == '-';
  if (negative || *at == '+') ++at;
  const char* after_point = nullptr;
  std::int64_t digits = 0;
  const char* const start = at;
  for (; at < cell.end; ++at) {
    if (*at >= '0' && *at <= '9') {
      digits = 10 * digits + (*at - '0');
    } else if (*at == point && after_point == nullptr) {
      after_point = at + 1;
    } else {
      return false;
    }
  }
  const auto count = at - start - (after_point == nullptr ? 0 : 1);
  if (count < 1 || count > 15) return false;
  value = static_cast<double>(digits);
  if (after_point != nullptr) value /= kPowers[at - after_point];
  if (negative) value = -value;
  return true;
}

bool longNumber(const CsvCell& cell, char point, double& value) {
  static const locale_t kCLocale = ::newlocale(LC_ALL_MASK, "C", nullptr);
  std::string text(cell.begin, cell.end);
  if (point == ',') {
    if (text.find('.') != std::string::npos) return false;
    std::replace(text.begin(), text.end(), ',', '.');
  }
  char* parsed = nullptr;
  value = ::strtod_l(text.c_str(), &parsed, kCLocale);
  return parsed == text.c_str() + text.size();
}

bool parseNumber(const CsvCell& cell, char point, double& value) {
  if (cell.empty()) return false;
  return shortNumber(cell, point, value) || longNumber(cell, point, value);
}

/// Whether the cell is this word, in whatever case.
bool isWord(const CsvCell& cell, const char* word) {
  const auto size = static_cast<std::ptrdiff_t>(std::strlen(word));
  const auto is_same = [](char left, char right) {
    return (left >= 'A' && left <= 'Z' ? left - 'A' + 'a' : left) == right;
  };
  return cell.end - cell.begin == size && std::equal(cell.begin, cell.end, word, is_same);
}

bool holds(const CsvCell& cell, char character) {
  return std::find(cell.begin, cell.end, character) != cell.end;
}

void splitAtBlanks(const char* begin, const char* end, std::vector<CsvCell>& cells) {
  for (const char* at = begin; at < end;) {
    while (at < end && isBlank(*at)) ++at;
    const char* const start = at;
    for (bool quoted = false; at < end && (quoted || !isBlank(*at)); ++at)
      if (*at == '"') quoted = !quoted;
    if (at > start) cells.push_back(trimmedCell(start, at));
  }
}

/// How many of the rows have as many cells as the header; -1 if that has only one.
long agreement(const CsvDialect& dialect, const std::string& header,
               const std::vector<std::string>& rows) {
  const std::size_t cells = dialect.split(header).size();
  if (cells < 2) return -1;
  return std::count_if(rows.begin(), rows.end(),
                       [&](const std::string& row) { return dialect.split(row).size() == cells; });
}

}  // namespace

std::string CsvCell::str() const {
  std::string text(begin, end);
  if (!quoted) return text;
  for (auto at = text.find("\"\""); at != std::string::npos; at = text.find("\"\"", at + 1))
    text.erase(at, 1);
  return text;
}

CsvCell trimmedCell(const char* begin, const char* end) {
  while (begin < end && isBlank(*begin)) ++begin;
  while (begin < end && isBlank(end[-1])) --end;
  if (end - begin >= 2 && *begin == '"' && end[-1] == '"') return {begin + 1, end - 1, true};
  return {begin, end, false};
}

void CsvDialect::split(const char* begin, const char* end, std::vector<CsvCell>& cells) const {
  cells.clear();
  if (separator_ == ' ') return splitAtBlanks(begin, end, cells);
  bool quoted = false;
  const char* start = begin;
  for (const char* at = begin; at < end; ++at) {
    if (*at == '"') quoted = !quoted;
    if (*at != separator_ || quoted) continue;
    cells.push_back(trimmedCell(start, at));
    start = at + 1;
  }
  cells.push_back(trimmedCell(start, end));
}

std::vector<CsvCell> CsvDialect::split(const std::string& line) const {
  std::vector<CsvCell> cells;
  split(line.data(), line.data() + line.size(), cells);
  return cells;
}

bool CsvDialect::number(const CsvCell& cell, double& value) {
  if (const std::optional<bool> state = switchState(cell)) {
    value = *state ? 1 : 0;
    return true;
  }
  if (point_ != '\0') return parseNumber(cell, point_, value) || grouped(cell, value);
  const char point = holds(cell, ',') ? ',' : '.';
  if (!parseNumber(cell, point, value)) return grouped(cell, value);
  if (holds(cell, point)) point_ = point;
  return true;
}

bool CsvDialect::grouped(const CsvCell& cell, double& value) {
  const std::optional<GroupedNumber> number = groupedNumber(cell.str());
  if (!number) return false;
  if (thousands_ != '\0' ? number->separator != thousands_ : !number->isClear()) return false;
  char point = number->point;
  if (point == '\0' && number->separator == ',') point = '.';
  if (point == '\0' && number->separator == '.') point = ',';
  if (point != '\0' && point_ != '\0' && point != point_) return false;
  if (point != '\0') point_ = point;
  thousands_ = number->separator;
  value = number->value;
  return true;
}

void CsvDialect::learn(const CsvCell& cell) {
  const std::optional<GroupedNumber> number = groupedNumber(cell.str());
  double ignored = 0;
  if (number && number->point != '\0') grouped(cell, ignored);
}

std::string CsvDialect::remedyFor(const CsvCell& cell) const {
  const std::string found = cell.str();
  if (const std::optional<GroupedNumber> number = groupedNumber(found)) {
    const bool open = !number->isClear() && thousands_ == '\0';
    return (open ? std::string("; it could be a decimal fraction or separate thousands")
                 : "; its thousands and decimals are not separated as in the other numbers") +
           ": write numbers without separators of thousands";
  }
  double ignored = 0;
  if (separator_ == ',' && parseNumber(cell, ',', ignored))
    return "; numbers with decimal commas need another separator, such as ;";
  return "";
}

std::optional<bool> switchState(const CsvCell& cell) {
  if (cell.empty() || (*cell.begin >= '0' && *cell.begin <= '9')) return std::nullopt;
  if (isWord(cell, "true") || isWord(cell, "on")) return true;
  if (isWord(cell, "false") || isWord(cell, "off")) return false;
  return std::nullopt;
}

bool looksNumeric(const CsvCell& cell) {
  double value = 0;
  return parseNumber(cell, '.', value) || parseNumber(cell, ',', value) ||
         groupedNumber(cell.str());
}

CsvDialect findDialect(const std::string& header, const std::vector<std::string>& rows) {
  CsvDialect best(',');
  long most = -1;
  for (const char separator : {'\t', ';', ',', ' '}) {
    const CsvDialect dialect(separator);
    const long agreeing = agreement(dialect, header, rows);
    if (agreeing > most) best = dialect;
    most = std::max(most, agreeing);
  }
  return best;
}

}  // namespace uncertainty_identification
