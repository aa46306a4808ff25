#include "io/csv_table.h"

#include <locale.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <unordered_map>

#include "data/text.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw FileError("cannot read '" + path + "': " + what);
}

std::string contentOf(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode))
    fail(path, "it is a folder; give a file in it");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) fail(path, std::strerror(errno));
  std::string content(static_cast<std::size_t>(std::max<off_t>(0, status.st_size)), '\0');
  std::size_t size = 0;
  for (;;) {  // the size is only a hint, because a pipe has none
    if (size == content.size()) content.resize(content.size() + 65536);
    const std::size_t read = std::fread(&content[size], 1, content.size() - size, file.get());
    if (read == 0) break;
    size += read;
  }
  if (std::ferror(file.get()) != 0) fail(path, std::strerror(errno));
  content.resize(size);
  return content;
}

/// A piece of the file's content; the content ends with a zero byte.
struct Cell {
  const char* begin = nullptr;
  const char* end = nullptr;
  bool quoted = false;

  std::string str() const {
    std::string text(begin, end);
    if (!quoted) return text;
    for (auto at = text.find("\"\""); at != std::string::npos; at = text.find("\"\"", at + 1))
      text.erase(at, 1);
    return text;
  }
};

bool isBlank(char character) { return character == ' ' || character == '\t' || character == '\r'; }

Cell trimmed(const char* begin, const char* end) {
  while (begin < end && isBlank(*begin)) ++begin;
  while (begin < end && isBlank(end[-1])) --end;
  if (end - begin >= 2 && *begin == '"' && end[-1] == '"') return {begin + 1, end - 1, true};
  return {begin, end, false};
}

/// Splits a line at its commas, except inside quotes.
void split(const char* begin, const char* end, std::vector<Cell>& cells) {
  cells.clear();
  bool quoted = false;
  const char* start = begin;
  for (const char* at = begin; at < end; ++at) {
    if (*at == '"') quoted = !quoted;
    if (*at != ',' || quoted) continue;
    cells.push_back(trimmed(start, at));
    start = at + 1;
  }
  cells.push_back(trimmed(start, end));
}

/// Reads a number written with a decimal point, whatever the locale of the program. False if the
/// cell holds anything else.
bool parseNumber(const Cell& cell, double& value) {
  static const locale_t kCLocale = ::newlocale(LC_ALL_MASK, "C", nullptr);
  if (cell.begin == cell.end) return false;
  char* parsed = nullptr;
  value = ::strtod_l(cell.begin, &parsed, kCLocale);
  return parsed == cell.end;
}

/// The meaning of each column.
struct Columns {
  static constexpr std::size_t kAbsent = std::numeric_limits<std::size_t>::max();
  std::size_t experiment = kAbsent, t = kAbsent, u = kAbsent, y = kAbsent;
  std::vector<std::size_t> covariates;
  std::vector<std::string> names;  ///< of all columns
};

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ",") + name;
  return list;
}

Columns readHeader(const std::vector<Cell>& cells, const std::string& path, long line) {
  Columns columns;
  for (const Cell& cell : cells) columns.names.push_back(cell.str());
  const std::string found = "line " + std::to_string(line) + " is '" + listed(columns.names) + "'";
  for (std::size_t i = 0; i < columns.names.size(); ++i) {
    const std::string& name = columns.names[i];
    if (name.empty() || std::count(columns.names.begin(), columns.names.end(), name) > 1) {
      fail(path, "no two columns may have the same name, but " + found);
    }
    if (name == "experiment") {
      columns.experiment = i;
    } else if (name == "t") {
      columns.t = i;
    } else if (name == "u") {
      columns.u = i;
    } else if (name == "y") {
      columns.y = i;
    } else {
      columns.covariates.push_back(i);
    }
  }
  for (const auto& [name, index] :
       {std::make_pair("t", columns.t), {"u", columns.u}, {"y", columns.y}}) {
    if (index == Columns::kAbsent) {
      fail(path,
           "the header must name the columns t, u and y (and optionally experiment and "
           "covariates), but " +
               found + ", without " + name);
    }
  }
  return columns;
}

std::string stemOf(const std::string& path) {
  const std::string name = path.substr(path.rfind('/') + 1);  // npos + 1 = 0
  const auto dot = name.rfind('.');
  return dot == std::string::npos || dot == 0 ? name : name.substr(0, dot);
}

/// Goes through the lines and sorts the rows by experiment.
class Parser {
 public:
  explicit Parser(const std::string& path) : content_(contentOf(path)) { file_.path = path; }

  CsvFile run() {
    const char* at = content_.c_str();
    const char* const end = at + content_.size();
    if (content_.compare(0, 3, "\xEF\xBB\xBF") == 0) at += 3;
    for (; at < end; ++line_) {
      const auto* next =
          static_cast<const char*>(std::memchr(at, '\n', static_cast<std::size_t>(end - at)));
      if (next == nullptr) next = end;
      readLine(at, next);
      at = next + 1;
    }
    if (columns_.names.empty())
      fail(file_.path,
           "the file is empty; write a header line such as t,u,y and one line per sample");
    if (file_.tables.empty()) {
      tableOf(stemOf(file_.path)).problem =
          file_.path + ": the file has a header but no rows; write one line per sample";
    }
    return std::move(file_);
  }

 private:
  void readLine(const char* begin, const char* end) {
    const Cell line = trimmed(begin, end);
    if (!line.quoted && (line.begin == line.end || *line.begin == '#')) return;
    split(begin, end, cells_);
    if (columns_.names.empty()) {
      columns_ = readHeader(cells_, file_.path, line_);
      for (const std::size_t i : columns_.covariates)
        file_.covariate_names.push_back(columns_.names[i]);
    } else {
      readRow();
    }
  }

  void readRow() {
    CsvTable& table = tableOfRow();
    if (!table.problem.empty()) return;
    if (cells_.size() != columns_.names.size()) {
      table.problem = file_.path + ", line " + std::to_string(line_) + ": found " +
                      std::to_string(cells_.size()) + " cells under " +
                      std::to_string(columns_.names.size()) +
                      " columns; write one cell per column, an empty one for a missing output";
      return;
    }
    table.lines.push_back(line_);
    table.t.push_back(number(columns_.t, false, table));
    table.u.push_back(number(columns_.u, false, table));
    table.y.push_back(number(columns_.y, true, table));
    for (std::size_t i = 0; i < columns_.covariates.size(); ++i) {
      table.covariates[i].push_back(number(columns_.covariates[i], true, table));
    }
  }

  CsvTable& tableOfRow() {
    if (columns_.experiment == Columns::kAbsent) {
      return file_.tables.empty() ? tableOf(stemOf(file_.path)) : file_.tables.front();
    }
    const bool found = columns_.experiment < cells_.size();
    CsvTable& table = tableOf(found ? cells_[columns_.experiment].str() : "");
    if (table.id.empty()) {
      table.problem =
          file_.path + ", line " + std::to_string(line_) +
          ", column experiment: the cell is empty; write the name of the experiment in every row";
    }
    return table;
  }

  CsvTable& tableOf(const std::string& id) {
    if (!file_.tables.empty() && file_.tables[last_].id == id) return file_.tables[last_];
    const auto [found, added] = index_.emplace(id, file_.tables.size());
    last_ = found->second;
    if (added) {
      file_.tables.emplace_back();
      file_.tables.back().id = id;
      file_.tables.back().covariates.resize(columns_.covariates.size());
    }
    return file_.tables[last_];
  }

  double number(std::size_t column, bool may_be_empty, CsvTable& table) {
    const Cell& cell = cells_[column];
    double value = std::numeric_limits<double>::quiet_NaN();
    if (may_be_empty && cell.begin == cell.end) return value;
    if (!parseNumber(cell, value) && table.problem.empty()) {
      table.problem = file_.path + ", line " + std::to_string(line_) + ", column " +
                      columns_.names[column] + ": found '" + cell.str() + "'; write a number" +
                      (may_be_empty ? ", or leave the cell empty if it was not measured" : "");
    }
    return value;
  }

  std::string content_;
  CsvFile file_;
  Columns columns_;
  std::vector<Cell> cells_;  ///< of the current line
  long line_ = 1;
  std::unordered_map<std::string, std::size_t> index_;  ///< of the tables, by id
  std::size_t last_ = 0;                                ///< table of the last row
};

}  // namespace

CsvFile parseCsv(const std::string& path) { return Parser(path).run(); }

}  // namespace uncertainty_identification
