#include "io/csv_table.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "data/text.h"
#include "io/csv_dates.h"
#include "io/csv_header.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kNoColumn = CsvSignal::kAbsent;

std::string stemOf(const std::string& path) {
  const std::string name = path.substr(path.rfind('/') + 1);  // npos + 1 = 0
  const auto dot = name.rfind('.');
  return dot == std::string::npos || dot == 0 ? name : name.substr(0, dot);
}

/// What programs write for a value that is not there.
bool isNothing(const CsvCell& cell) {
  if (cell.empty()) return true;
  const std::string word = cell.str();
  return word == "NA" || word == "N/A" || word == "null" || word == "NULL" || word == "None";
}

/// Goes through the lines and sorts the rows by experiment.
class Parser {
 public:
  Parser(const std::string& path, const Configuration& configuration)
      : lines_(path), head_(readHead(path, lines_)), names_(head_.header.names) {
    columns_ = chooseColumns(head_.header, configuration);
    file_.path = path;
    file_.has_experiments = columns_.experiment != kNoColumn;
    if (columns_.time != kNoColumn) file_.time_name = names_[columns_.time];
    file_.unit_is_assumed = columns_.unit_is_assumed;
    if (columns_.has_dates)
      dates_.emplace(CsvTimeColumn{path, columns_.time, head_.dialect, head_.first_row});
    for (const CsvSignal& each : columns_.covariates) file_.covariate_names.push_back(each.name);
  }

  CsvFile run() {
    while (lines_.next()) {
      if (lines_.number() < head_.first_row || isCsvRemark(lines_.begin(), lines_.end())) continue;
      head_.dialect.split(lines_.begin(), lines_.end(), cells_);
      while (cells_.size() > names_.size() && cells_.back().empty()) cells_.pop_back();
      readRow();
    }
    if (file_.tables.empty()) {
      tableOf(stemOf(file_.path)).problem =
          file_.path + ": the file has a header but no rows; write one line per sample";
    }
    file_.remarks = std::move(columns_.remarks);
    if (dates_) finishDates();
    if (head_.dialect.hasDecimalComma()) file_.remarks.push_back("commas are decimal points");
    if (const char thousands = head_.dialect.thousands())
      file_.remarks.push_back(std::string("thousands are separated by '") + thousands + "'");
    return std::move(file_);
  }

 private:
  std::string place() const { return file_.path + ", line " + std::to_string(lines_.number()); }

  std::string place(std::size_t column) const {
    return place() + ", column " + (column == kNoColumn ? "t" : names_[column]);
  }

  void readRow() {
    CsvTable& table = tableOfRow();
    if (!table.problem.empty()) return;
    if (cells_.size() != names_.size()) {
      table.problem = place() + ": found " + std::to_string(cells_.size()) + " cells under " +
                      std::to_string(names_.size()) +
                      " columns; write one cell per column, an empty one for a missing output" +
                      (cells_.size() > names_.size() ? remedyForMoreCells() : "");
      return;
    }
    readTime(table);
    const double u = number(columns_.input, table);
    if (std::isnan(u) && isNothing(cells_[columns_.input.column])) ++table.rows_without_input;
    table.u.push_back(u);
    table.y.push_back(output(table));
    for (std::size_t i = 0; i < columns_.covariates.size(); ++i)
      table.covariates[i].push_back(number(columns_.covariates[i], table));
    if (columns_.marker != kNoColumn) readMarker(table);
  }

  std::string remedyForMoreCells() const {
    const char separator = head_.dialect.separator();
    if (separator == ',')
      return "; numbers with decimal commas need another separator, such as ;, and numbers with "
             "commas between thousands need quotes";
    return separator == ' ' ? "; numbers and dates with blanks in them need quotes" : "";
  }

  void readTime(CsvTable& table) {
    if (dates_) return readDate(table);
    double value = static_cast<double>(table.t.size());
    if (columns_.time != kNoColumn && !head_.dialect.number(cells_[columns_.time], value)) {
      table.problem = place(columns_.time) + ": found '" + cells_[columns_.time].str() +
                      "'; write a number, or choose another column by time: {column: NAME}" +
                      (parseStamp(cells_[columns_.time])
                           ? "; dates and times of day are read if the whole column holds them"
                           : head_.dialect.remedyFor(cells_[columns_.time]));
      return;
    }
    const double t = value / columns_.per_second;
    if (table.t.empty() ? std::isfinite(t) : t > table.t.back() && std::isfinite(t)) {
      table.t.push_back(t);
    } else if (!std::isfinite(t)) {
      table.problem =
          place(columns_.time) + ": found " + text(value) + "; write finite stamps in seconds";
    } else {
      const std::string kind = t == table.t.back() ? "repeats" : "goes back from";
      table.problem = place(columns_.time) + ": the stamp " + text(t) + " s " + kind + " " +
                      text(table.t.back()) +
                      " s; stamps must rise within an experiment; name experiments in the column "
                      "experiment, or in another one by experiment: {column: NAME}";
    }
  }

  void readDate(CsvTable& table) {
    const CsvCell& cell = cells_[columns_.time];
    std::string problem;
    const double t = dates_->seconds(cell, last_, problem);
    if (problem.empty() && !table.t.empty() && t <= table.t.back())
      problem = "the stamp " + cell.str() + (t == table.t.back() ? " repeats" : " goes back from") +
                " the one before; stamps must rise within an experiment; name experiments in the "
                "column experiment, or in another one by experiment: {column: NAME}";
    if (problem.empty())
      table.t.push_back(t);
    else
      table.problem = place(columns_.time) + ": " + problem;
  }

  void finishDates() {
    for (std::size_t i = 0; i < file_.tables.size(); ++i) file_.tables[i].start = dates_->start(i);
    if (const std::string how = dates_->remark(); !how.empty())
      file_.remarks.push_back("the time is '" + file_.time_name + "', read " + how);
  }

  /// NaN for what is not measured.
  double output(CsvTable& table) {
    const double y = number(columns_.output, table);
    if (std::isfinite(y)) return y;
    ++(isNothing(cells_[columns_.output.column]) ? table.empty_outputs : table.bad_outputs);
    return std::nan("");
  }

  double number(const CsvSignal& signal, CsvTable& table) {
    const CsvCell& cell = cells_[signal.column];
    double value = 0;
    if (head_.dialect.number(cell, value)) return signal.scale * value + signal.offset;
    if (!isNothing(cell) && table.problem.empty()) {
      table.problem = place(signal.column) + ": found '" + cell.str() +
                      "'; write a number, or leave the cell empty if it was not measured" +
                      head_.dialect.remedyFor(cell);
    }
    return std::nan("");
  }

  void readMarker(CsvTable& table) {
    const CsvCell& cell = cells_[columns_.marker];
    const std::string word = cell.str();
    double value = word == "true" || word == "True" || word == "TRUE" ? 1 : 0;
    const bool is_word = value == 1 || word == "false" || word == "False" || word == "FALSE";
    if (isNothing(cell))
      value = -1;
    else if (!is_word && !head_.dialect.number(cell, value) && table.problem.empty())
      table.problem =
          place(columns_.marker) + ": found '" + word + "'; write 1 or 0, true or false";
    table.markers.push_back(static_cast<std::int8_t>(value < 0 ? -1 : value != 0 ? 1 : 0));
  }

  CsvTable& tableOfRow() {
    if (!file_.has_experiments)
      return file_.tables.empty() ? tableOf(stemOf(file_.path)) : file_.tables.front();
    const bool found = columns_.experiment < cells_.size();
    CsvTable& table = tableOf(found ? cells_[columns_.experiment].str() : "");
    if (table.id.empty()) {
      table.problem = place(columns_.experiment) +
                      ": the cell is empty; write the name of the experiment in every row";
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
      file_.tables.back().first_line = std::max(1L, lines_.number());
      file_.tables.back().covariates.resize(columns_.covariates.size());
    }
    return file_.tables[last_];
  }

  CsvLines lines_;
  CsvHead head_;
  const std::vector<std::string>& names_;  ///< of the columns
  CsvColumns columns_;
  CsvFile file_;
  std::optional<CsvDates> dates_;                       ///< where the stamps are no numbers
  std::vector<CsvCell> cells_;                          ///< of the current line
  std::unordered_map<std::string, std::size_t> index_;  ///< of the tables, by id
  std::size_t last_ = 0;                                ///< table of the last row
};

}  // namespace

CsvFile parseCsv(const std::string& path, const Configuration& configuration) {
  return Parser(path, configuration).run();
}

}  // namespace uncertainty_identification
