#include "io/csv_header.h"

#include <algorithm>

#include "io/csv_stamp.h"
#include "io/csv_time_names.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kLooked = 200;  // lines from which dialect and header are found

struct NumberedLine {
  long number = 0;
  std::string text;
};

std::vector<std::string> namesOf(const std::vector<CsvCell>& cells) {
  std::vector<std::string> names;
  for (const CsvCell& cell : cells) names.push_back(cell.str());
  while (names.size() > 1 && names.back().empty()) names.pop_back();  // a separator at the end
  return names;
}

bool anyNumber(const std::vector<CsvCell>& cells) {
  return std::any_of(cells.begin(), cells.end(), looksNumeric);
}

/// Whether a line holds samples: most of its cells are numbers, dates or times of day.
bool mostAreNumbers(const std::vector<CsvCell>& cells) {
  const auto is_value = [](const CsvCell& cell) { return looksNumeric(cell) || parseStamp(cell); };
  return 2 * std::count_if(cells.begin(), cells.end(), is_value) >=
         static_cast<std::ptrdiff_t>(cells.size());
}

/// A comment without its sign, except for the name %time of rostopic echo -p.
std::string uncommented(const std::string& line) {
  const auto begin = line.find('%');
  if (begin != std::string::npos && line.compare(begin, 6, "%time,") == 0)
    return line.substr(begin);
  return line.substr(std::min(line.size(), line.find_first_not_of(" \t#%/")));
}

/// Goes through the first lines of a file.
class HeadFinder {
 public:
  HeadFinder(const std::string& path, const std::vector<std::string>& lines) {
    head_.header.path = path;
    for (std::size_t i = 0; i < lines.size(); ++i) sort({static_cast<long>(i) + 1, lines[i]});
    if (table_.empty())
      refuseFile(path,
                 "the file is empty; write a header line such as t,u,y and one line per sample");
  }

  CsvHead run() {
    passOverTitles();
    const std::string first = table_.front().text;
    head_.dialect = dialectBelow(first, 1);
    if (mostAreNumbers(head_.dialect.split(first)))
      takeComment();
    else
      takeNames(table_.front(), 1);
    takeUnits();
    findTexts();
    return std::move(head_);
  }

 private:
  void sort(const NumberedLine& line) {
    const char* const begin = line.text.data();
    const char* const end = begin + line.text.size();
    if (table_.empty() && line.text.size() >= 5 && line.text.compare(0, 4, "sep=") == 0 &&
        trimmedCell(begin + 5, end).empty())
      separator_ = line.text[4];
    else if (!isCsvRemark(begin, end))
      table_.push_back(line);
    else if (table_.empty() && !trimmedCell(begin, end).empty())
      comment_ = line;
  }

  /// Passes over lines of a single cell above rows of several: what a logger writes of itself.
  void passOverTitles() {
    if (separator_ != '\0' || table_.size() < 4) return;
    const std::string& typical = table_[table_.size() / 2].text;
    const CsvDialect dialect = dialectBelow(typical, 0);
    const auto cells = [&](const NumberedLine& line) {
      return namesOf(dialect.split(line.text)).size();
    };
    const std::size_t columns = dialect.split(typical).size();
    const auto is_title = [&](const NumberedLine& line) { return cells(line) == 1; };
    const auto first = std::find_if_not(table_.begin(), table_.end(), is_title);
    const auto whole = std::count_if(
        first, table_.end(), [&](const NumberedLine& line) { return cells(line) == columns; });
    const auto titles = first - table_.begin();
    if (columns < 2 || titles == 0 || 2 * whole < table_.end() - first) return;
    head_.header.titles = titles;
    comment_ = {};
    table_.erase(table_.begin(), first);
  }

  CsvDialect dialectBelow(const std::string& header, std::size_t first_row) const {
    if (separator_ != '\0') return CsvDialect(separator_);
    std::vector<std::string> rows;
    for (std::size_t i = first_row; i < table_.size(); ++i) rows.push_back(table_[i].text);
    return findDialect(header, rows);
  }

  void takeNames(const NumberedLine& line, std::size_t first_row) {
    head_.header.line = line.number;
    head_.header.names = namesOf(head_.dialect.split(line.text));
    row_ = first_row;
    head_.first_row = row_ < table_.size() ? table_[row_].number : line.number + 1;
  }

  /// For a table that begins with numbers: the comment above it may hold the names.
  void takeComment() {
    const std::string names = uncommented(comment_.text);
    const CsvDialect dialect = dialectBelow(names, 0);
    const std::vector<CsvCell> cells = dialect.split(names);
    const std::size_t columns = dialect.split(table_.front().text).size();
    if (comment_.number == 0 || cells.size() != columns || cells.size() < 2 || anyNumber(cells))
      return inventNames();
    head_.dialect = dialect;
    takeNames({comment_.number, names}, 0);
  }

  /// For numbers without names above them: t where they rise like a clock, column2, column3, ...
  void inventNames() {
    head_.dialect = dialectBelow(table_.front().text, 1);
    head_.first_row = table_.front().number;
    const std::size_t columns = namesOf(head_.dialect.split(table_.front().text)).size();
    for (std::size_t i = 0; i < columns; ++i)
      head_.header.names.push_back("column" + std::to_string(i + 1));
    if (columns > 2 && firstColumnIsClock()) head_.header.names.front() = "t";
  }

  /// Whether the first column rises, by steps of which none is twice as long as another.
  bool firstColumnIsClock() const {
    CsvDialect dialect = head_.dialect;
    std::vector<double> steps;
    double before = 0, stamp = 0;
    for (const NumberedLine& line : table_) {
      const std::vector<CsvCell> cells = dialect.split(line.text);
      if (cells.empty() || !dialect.number(cells.front(), stamp)) return false;
      if (&line != &table_.front()) steps.push_back(stamp - before);
      before = stamp;
    }
    if (steps.size() < 2) return false;
    const auto [shortest, longest] = std::minmax_element(steps.begin(), steps.end());
    return *shortest > 0 && *longest < 2 * *shortest;
  }

  /// A row without numbers below the names, one cell of which is a unit of time.
  void takeUnits() {
    if (row_ + 1 >= table_.size()) return;  // the only row
    const std::vector<CsvCell> cells = head_.dialect.split(table_[row_].text);
    if (anyNumber(cells) || cells.size() > head_.header.names.size()) return;
    std::vector<std::string> units(head_.header.names.size());
    bool has_unit = false;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const CsvName name = splitUnit(cells[i].str());
      units[i] = name.base.empty() ? name.unit : name.base;
      const bool is_time_unit = perSecond(units[i]).has_value();
      if (timeName(head_.header.names[i]) && !cells[i].empty() && !is_time_unit) return;
      has_unit = has_unit || is_time_unit;
    }
    const bool is_below = anyNumber(head_.dialect.split(table_[row_ + 1].text));
    if (!is_below || !has_unit) return;
    head_.header.units = std::move(units);
    head_.first_row = table_[++row_].number;
  }

  void findTexts() {
    std::vector<bool>& is_text = head_.header.is_text;
    is_text.assign(head_.header.names.size(), false);
    std::vector<bool> is_number = is_text;
    std::vector<long> stamps(is_text.size(), 0);  // less the number of other cells
    for (std::size_t r = row_; r < table_.size(); ++r) {
      const std::vector<CsvCell> cells = head_.dialect.split(table_[r].text);
      for (std::size_t i = 0; i < std::min(cells.size(), is_text.size()); ++i) {
        if (cells[i].empty()) continue;
        (looksNumeric(cells[i]) ? is_number : is_text)[i] = true;
        stamps[i] += parseStamp(cells[i]) ? 1 : -1;
      }
    }
    for (std::size_t i = 0; i < is_text.size(); ++i) {
      is_text[i] = is_text[i] && !is_number[i];
      head_.header.is_stamp.push_back(stamps[i] > 0);
    }
    learnThousands();
  }

  /// A later number may tell how an earlier one is meant.
  void learnThousands() {
    for (std::size_t r = row_; r < table_.size(); ++r) {
      const std::vector<CsvCell> cells = head_.dialect.split(table_[r].text);
      for (std::size_t i = 0; i < std::min(cells.size(), head_.header.is_text.size()); ++i)
        if (!head_.header.is_text[i]) head_.dialect.learn(cells[i]);
    }
  }

  CsvHead head_;
  std::vector<NumberedLine> table_;  ///< the lines that are no remarks
  NumberedLine comment_;             ///< the last one above them
  char separator_ = '\0';            ///< as a line "sep=;" says
  std::size_t row_ = 0;              ///< of table_, the first one with numbers
};

}  // namespace

bool isCsvRemark(const char* begin, const char* end) {
  while (begin < end && (*begin == ' ' || *begin == '\t' || *begin == '\r')) ++begin;
  if (begin == end || *begin == '#' || *begin == '%') return true;
  return end - begin > 1 && begin[0] == '/' && begin[1] == '/';
}

CsvHead readHead(const std::string& path, CsvLines& lines) {
  return HeadFinder(path, lines.first(kLooked)).run();
}

}  // namespace uncertainty_identification
