#include "io/csv_columns.h"

#include <algorithm>
#include <optional>

#include "configuration/edit_distance.h"
#include "io/csv_lines.h"
#include "io/csv_time_names.h"
#include "uncertainty_identification/enum_names.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kAbsent = CsvSignal::kAbsent;
constexpr std::size_t kListed = 12;  // names that a message lists

std::string list(const std::vector<std::string>& names) {
  std::string text;
  const std::size_t shown = std::min(kListed, names.size());
  for (std::size_t i = 0; i < shown; ++i) text += (i == 0 ? "" : ",") + names[i];
  if (names.size() > shown) text += " and " + std::to_string(names.size() - shown) + " more";
  return text;
}

/// Finds the columns of one file.
class Chooser {
 public:
  Chooser(const CsvHeader& header, const Configuration& configuration)
      : header_(header), configuration_(configuration) {}

  CsvColumns run() {
    if (header_.titles == 1) remark("a line above the table is passed over");
    if (header_.titles > 1)
      remark(std::to_string(header_.titles) + " lines above the table are passed over");
    if (header_.line == 0)
      remark("no line names the columns, which are called '" + list(header_.names) + "'");
    chooseExperiment();
    chooseTime();
    columns_.input = signal(configuration_.input, "input", "u");
    columns_.output = signal(configuration_.output, "output", "y");
    chooseCovariates();
    return std::move(columns_);
  }

 private:
  std::string found() const {
    if (header_.line == 0)
      return "there is no header line, and the columns are called '" + list(header_.names) + "'";
    return "line " + std::to_string(header_.line) + " is '" + list(header_.names) + "'";
  }

  /// The column of this name, or else the only one that is called so apart from its unit.
  std::size_t find(const std::string& name) const {
    const auto only = [&](const auto& matches) {
      const auto begin = header_.names.begin(), end = header_.names.end();
      const auto first = std::find_if(begin, end, matches);
      if (first == end) return kAbsent;
      if (std::find_if(first + 1, end, matches) != end)
        refuseFile(header_.path, "no two columns may have the same name, but " + found() +
                                     "; rename one of those that are called " + name);
      return static_cast<std::size_t>(first - begin);
    };
    const std::size_t exact = only([&](const std::string& other) { return other == name; });
    if (exact != kAbsent) return exact;
    return only([&](const std::string& other) { return splitUnit(other).base == name; });
  }

  std::size_t configured(const std::string& key, const std::string& name) const {
    const std::size_t column = find(name);
    if (column != kAbsent) return column;
    if (header_.line == 0 && name == "column1") return 0;  // called t where it rises like a clock
    const auto nearest = std::min_element(
        header_.names.begin(), header_.names.end(), [&](const auto& left, const auto& right) {
          return editDistance(name, left) < editDistance(name, right);
        });
    throw ConfigurationError(key + ": '" + header_.path + "' has no column '" + name +
                             "'; the nearest name is '" + *nearest + "', and " + found());
  }

  void chooseExperiment() {
    const ExperimentOptions& options = configuration_.experiment;
    columns_.experiment = options.column.empty() ? find("experiment")
                                                 : configured("experiment.column", options.column);
    if (options.mode == ExperimentMode::topic) chooseMarker(options.topic);
  }

  /// A topic in a file is the column that a program which exports bags makes of it.
  void chooseMarker(const std::string& topic) {
    if (topic.empty()) return;
    const std::string bare = topic.front() == '/' ? topic.substr(1) : topic;
    for (const std::string& name : {bare, "/" + bare})
      for (const char* field : {"", "/data", "/active", ".data", ".active"})
        if (columns_.marker == kAbsent) columns_.marker = find(name + field);
    if (columns_.marker != kAbsent)
      remark("the experiments are marked by '" + header_.names[columns_.marker] + "'");
    else if (topic != ExperimentOptions{}.topic && columns_.experiment == kAbsent)
      remark("no column marks experiments (experiment.topic: " + topic +
             "), so that the file is one experiment");
  }

  void chooseTime() {
    const TimeOptions& time = configuration_.time;
    if (!time.column.empty())
      columns_.time = configured("time.column", time.column);
    else if (!time.counts())
      columns_.time = knownTime();
    columns_.has_dates = columns_.time != kAbsent && header_.is_stamp[columns_.time];
    if (columns_.has_dates)
      requireNoUnit(time);
    else
      columns_.per_second = secondsOf(time);
  }

  void requireNoUnit(const TimeOptions& time) const {
    if (time.unit == TimeUnit::automatic) return;
    throw ConfigurationError("time.unit: '" + header_.path + "' holds dates or times of day in '" +
                             header_.names[columns_.time] +
                             "', which have no unit; leave time.unit out, or choose another column "
                             "by time.column");
  }

  std::size_t knownTime() const {
    if (const std::size_t t = find("t"); t != kAbsent) return t;
    std::vector<std::string> candidates, stamps;
    for (const std::string& name : header_.names)
      if (timeName(name)) candidates.push_back(name);
    for (std::size_t i = 0; candidates.empty() && i < header_.names.size(); ++i)
      if (header_.is_stamp[i]) stamps.push_back(header_.names[i]);
    if (stamps.size() == 1) return find(stamps.front());
    candidates.insert(candidates.end(), stamps.begin(), stamps.end());
    if (candidates.size() == 1) return find(candidates.front());
    refuseFile(
        header_.path,
        (candidates.empty() ? "no column is known to be the time t"
                            : "the time could be any of '" + list(candidates) + "'") +
            std::string(": ") + found() +
            "; write time: {column: NAME, unit: ms} (unit: s, ms, us, ns, min, h or d) into the "
            "configuration, without such a column time: {sample_time: 0.01}");
  }

  double secondsOf(const TimeOptions& time) {
    if (time.counts()) return 1 / time.sample_time;
    if (time.unit != TimeUnit::automatic) {
      for (const auto& [unit, name] : enumNames(time.unit))
        if (unit == time.unit) return *perSecond(name);
    }
    const std::string& name = header_.names[columns_.time];
    const std::optional<CsvTimeName> known = timeName(name);
    const std::string of_name = known ? known->unit : splitUnit(name).unit;
    const std::string of_row = header_.units.empty() ? "" : header_.units[columns_.time];
    const std::optional<double> by_name = perSecond(of_name), by_row = perSecond(of_row);
    if (by_name && by_row && *by_name != *by_row)
      refuseFile(header_.path, "the unit of column " + name + " is " + of_name +
                                   " by its name and " + of_row +
                                   " by the row below it; write time: {unit: " + of_row +
                                   "} or the one that is right into the configuration");
    columns_.unit_is_assumed = !by_name && !by_row;
    const double per_second = by_name ? *by_name : by_row.value_or(1);
    if (name != "t" || per_second != 1)
      remark("the time is '" + name + "' in " +
             (columns_.unit_is_assumed ? "s (assumed)"
              : by_name                ? of_name
                                       : of_row));
    return per_second;
  }

  CsvSignal signal(const SignalOptions& options, const std::string& key, const std::string& usual) {
    std::size_t column = kAbsent;
    if (!options.column.empty()) {
      column = configured(key + ".column", options.column);
    } else {
      column = find(usual);
    }
    if (column == kAbsent)
      refuseFile(header_.path,
                 "the " + key + " is not known: " + found() + ", without " + usual + "; write " +
                     key + ": {column: NAME} into the configuration, or name the column " + usual);
    return {column, usual, options.scale, options.offset};
  }

  /// By the configuration if that names any column, otherwise all columns that are left.
  void chooseCovariates() {
    const auto& listed = configuration_.covariates;
    const bool by_name = !configuration_.input.column.empty() ||
                         !configuration_.output.column.empty() ||
                         std::any_of(listed.begin(), listed.end(),
                                     [](const auto& each) { return !each.column.empty(); });
    for (const SignalOptions& each : listed) {
      const std::size_t column = each.column.empty()
                                     ? find(each.name)
                                     : configured("covariates: {column: ...}", each.column);
      if (column != kAbsent)
        columns_.covariates.push_back({column, each.name, each.scale, each.offset});
    }
    std::vector<std::string> texts, unused;
    for (std::size_t i = 0; i < header_.names.size(); ++i) {
      const bool is_unused_time = columns_.time == kAbsent && timeName(header_.names[i]);
      if (isChosen(i) || header_.names[i].empty() || is_unused_time) continue;
      if (by_name)
        unused.push_back(header_.names[i]);
      else if (header_.is_text[i])
        texts.push_back(header_.names[i]);
      else
        addCovariate(i);
    }
    if (!texts.empty()) remark("the text columns '" + list(texts) + "' are passed over");
    if (!unused.empty())
      remark("the columns '" + list(unused) + "' are not used (covariates: names those to keep)");
  }

  bool isChosen(std::size_t column) const {
    const auto& covariates = columns_.covariates;
    return column == columns_.experiment || column == columns_.marker || column == columns_.time ||
           column == columns_.input.column || column == columns_.output.column ||
           std::any_of(covariates.begin(), covariates.end(),
                       [&](const CsvSignal& each) { return each.column == column; });
  }

  void addCovariate(std::size_t column) {
    const std::string& name = header_.names[column];
    if (std::count(header_.names.begin(), header_.names.end(), name) > 1)
      refuseFile(header_.path, "no two columns may have the same name, but " + found());
    columns_.covariates.push_back({column, name});
  }

  void remark(const std::string& what) { columns_.remarks.push_back(what); }

  const CsvHeader& header_;
  const Configuration& configuration_;
  CsvColumns columns_;
};

}  // namespace

CsvColumns chooseColumns(const CsvHeader& header, const Configuration& configuration) {
  return Chooser(header, configuration).run();
}

}  // namespace uncertainty_identification
