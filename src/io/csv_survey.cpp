#include "io/csv_survey.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "inspection/signal_names.h"
#include "io/csv_header.h"
#include "io/csv_table.h"
#include "io/csv_time_names.h"
#include "uncertainty_identification/enum_names.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kMostColumns = 500;  // that are read

const char* const kDates = "dates";

std::string inQuotes(const std::string& name) { return "'" + name + "'"; }

/// Finds out how one file is read, and reads it.
class CsvSurveyor {
 public:
  CsvSurveyor(const std::string& path, const Configuration& configuration)
      : path_(path), probe_(configuration) {
    CsvLines lines(path);
    header_ = readHead(path, lines).header;
    if (header_.line == 0)
      remark(
          "no line names the columns: they are called t, where the first column rises like a "
          "clock, or column1, column2 and so on, by which the configuration can name them");
  }

  Survey run() {
    chooseTime();
    chooseExperiments();
    probe_.input = probe_.output = SignalOptions();
    probe_.covariates.clear();
    chooseNumbers();
    const CsvColumns columns = chooseColumns(header_, probe_);
    const CsvFile file = parseCsv(path_, probe_);
    tellTime(columns);
    for (const CsvTable& table : file.tables) addStream(table);
    survey_.records = file.tables.size();
    for (std::size_t i = 0; i < numbers_.size(); ++i) addChannel(i, file);
    return std::move(survey_);
  }

 private:
  void remark(const std::string& what) { survey_.remarks.push_back(what); }

  std::vector<std::string> timeCandidates() {
    std::vector<std::string> called_t, known, stamps;
    for (std::size_t i = 0; i < header_.names.size(); ++i) {
      const std::string& name = header_.names[i];
      const bool is_t = splitUnit(name).base == "t";
      if (!is_t && !timeName(name)) continue;
      if (header_.is_text[i] && !header_.is_stamp[i])
        remark("the column " + inQuotes(name) +
               " holds texts that are neither numbers nor dates or times of day");
      else
        (is_t ? called_t : known).push_back(name);
    }
    for (std::size_t i = 0; known.empty() && i < header_.names.size(); ++i)
      if (header_.is_stamp[i]) stamps.push_back(header_.names[i]);
    known.insert(known.end(), stamps.begin(), stamps.end());
    return called_t.empty() ? known : called_t;
  }

  void chooseTime() {
    TimeOptions& time = probe_.time;
    if (!time.column.empty() || time.counts()) return;
    const std::vector<std::string> candidates = timeCandidates();
    if (candidates.empty()) {
      time.unit = TimeUnit::index;
      time.sample_time = 1;
      remark(
          "no column is known to hold the time: the rows are counted, and a row is taken for "
          "1 s; state the real sample time, or time: {column: NAME, unit: ms}");
      return;
    }
    time.column = candidates.front();
    if (candidates.size() > 1)
      remark("the time could be " + inQuotes(candidates[0]) + " or " + inQuotes(candidates[1]) +
             ": the first is taken; time: {column: NAME} chooses another");
  }

  /// A column such as `run`, if no column is called experiment.
  void chooseExperiments() {
    std::string& column = probe_.experiment.column;
    const auto has = [&](const std::string& name) {
      return std::find(header_.names.begin(), header_.names.end(), name) != header_.names.end();
    };
    if (!column.empty() || has("experiment")) return;
    for (const std::string& name : header_.names) {
      std::string word = name;
      std::transform(word.begin(), word.end(), word.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      for (const char* known : {"run", "run_id", "trial", "trial_id", "episode", "experiment_id"})
        if (column.empty() && word == known) column = name;
    }
    if (!column.empty()) remark("the column " + inQuotes(column) + " is taken to name experiments");
  }

  /// All columns of numbers become covariates, the first also the input and the output.
  void chooseNumbers() {
    std::string texts, twice;
    for (std::size_t i = 0; i < header_.names.size(); ++i) {
      const std::string& name = header_.names[i];
      const bool is_named = name == probe_.time.column || name == probe_.experiment.column ||
                            (name == "experiment" && probe_.experiment.column.empty());
      if (name.empty() || is_named || timeName(name)) continue;
      const bool is_twice = std::count(header_.names.begin(), header_.names.end(), name) > 1;
      std::string* const passed_over = is_twice ? &twice : header_.is_text[i] ? &texts : nullptr;
      if (passed_over != nullptr)
        *passed_over += (passed_over->empty() ? "" : ", ") + inQuotes(name);
      else if (numbers_.size() < kMostColumns)
        numbers_.push_back(i);
    }
    if (!texts.empty()) remark("columns of text, passed over: " + texts);
    if (!twice.empty()) remark("columns of the same name, passed over: " + twice);
    if (numbers_.empty()) refuseFile(path_, "it holds no column of numbers beside the time");
    for (const std::size_t i : numbers_) {
      SignalOptions signal;
      signal.name = signal.column = header_.names[i];
      probe_.covariates.push_back(signal);
    }
    probe_.input = probe_.output = probe_.covariates.front();
  }

  void tellTime(const CsvColumns& columns) {
    SurveyedTime time;
    if (columns.time != CsvSignal::kAbsent) time.column = header_.names[columns.time];
    time.assumed = columns.unit_is_assumed;
    time.unit = "index";
    if (columns.has_dates) time.unit = kDates;
    if (!columns.has_dates && !probe_.time.counts())
      for (const char* unit : {"s", "ms", "us", "ns", "min", "h", "d"})
        if (*perSecond(unit) == columns.per_second) time.unit = unit;
    if (columns.experiment != CsvSignal::kAbsent)
      time.experiments = header_.names[columns.experiment];
    survey_.times.push_back(time);
  }

  void addStream(const CsvTable& table) {
    SurveyedStream stream{path_, table.id, "", summaryOf(table.t), {}, table.problem};
    for (const std::size_t i : numbers_) stream.fields.push_back(header_.names[i]);
    survey_.streams.push_back(std::move(stream));
  }

  void addChannel(std::size_t number, const CsvFile& file) {
    Channel channel;
    channel.name = channel.column = header_.names[numbers_[number]];
    channel.unit = unitOfName(channel.name);
    if (!header_.units.empty() && !header_.units[numbers_[number]].empty())
      channel.unit = header_.units[numbers_[number]];
    for (const CsvTable& table : file.tables) {
      StampedSignal record;
      const std::vector<double>& values = table.covariates[number];
      for (std::size_t k = 0; k < std::min(values.size(), table.t.size()); ++k) {
        if (!std::isfinite(values[k])) {
          ++(std::isnan(values[k]) ? channel.empty : channel.not_finite);
          continue;
        }
        record.stamps.push_back(table.t[k]);
        record.values.push_back(values[k]);
      }
      channel.records.push_back(std::move(record));
    }
    survey_.channels.push_back(std::move(channel));
  }

  const std::string path_;
  Configuration probe_;  ///< reads every column of numbers
  CsvHeader header_;
  std::vector<std::size_t> numbers_;  ///< columns of numbers
  Survey survey_;
};

}  // namespace

Survey surveyCsv(const std::string& path, const Configuration& configuration) {
  return CsvSurveyor(path, configuration).run();
}

}  // namespace uncertainty_identification
