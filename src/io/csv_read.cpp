#include <algorithm>
#include <cmath>
#include <utility>

#include "data/covariates.h"
#include "data/false_readings.h"
#include "data/sample_grid.h"
#include "data/text.h"
#include "io/csv_division.h"
#include "io/csv_table.h"
#include "uncertainty_identification/io/csv.h"

namespace uncertainty_identification {
namespace {

constexpr double kLongest = 10, kShortest = 1e-6;  // [s] sample times that need no question
constexpr double kSameRate = 1e-3;  // relative difference of sample times that count as equal
constexpr double kNoticeable =
    1e-3;  // [sample times] smaller jitter is taken for the rounding of printed stamps

std::string assumptions(const CsvFile& file) {
  std::string what;
  for (const std::string& remark : file.remarks) what += (what.empty() ? "" : "; ") + remark;
  return "the columns were read as follows: " + what;
}

/// Tells, once for a file, that its time may not be in the unit that was assumed: loggers also
/// print milliseconds and counts of rows as whole numbers.
void warnOfTime(CsvFile& file, const CsvTable& table, double period, LoadedData& data) {
  if (!file.unit_is_assumed) return;
  const bool whole =
      std::all_of(table.t.begin(), table.t.end(), [](double t) { return t == std::floor(t); });
  if (!whole && period <= kLongest && period >= kShortest) return;
  file.unit_is_assumed = false;
  const std::string found = file.path + ": " + file.time_name + " holds " +
                            (whole ? "whole numbers " : "stamps ") + text(period) +
                            " apart, taken for seconds: ";
  const char* const remedy =
      period < kShortest ? "if they are not, write time: {unit: NAME}, one of s, ms, us, ns"
      : whole && period < kLongest
          ? "if they are milliseconds, write time: {unit: ms}; if they count the rows, time: "
            "{unit: index, sample_time: 0.01}; if they are seconds, time: {unit: s}"
          : "if they are milliseconds, write time: {unit: ms}; if they are seconds, "
            "time: {unit: s}";
  data.warnings.push_back(found + remedy);
}

/// Whether the rows can be used as samples without resampling.
bool fitsGrid(const SampleGrid& grid, const Configuration& options) {
  const double wanted = options.sample_time > 0 ? options.sample_time : grid.period;
  const double jitter_limit = options.resampling.max_jitter;
  const auto rows = static_cast<double>(grid.slots.size());
  const double samples = static_cast<double>(grid.slots.back()) + 1;
  return grid.one_to_one && std::abs(grid.period - wanted) <= kSameRate * wanted &&
         !(jitter_limit > 0 && grid.max_departure > jitter_limit) &&
         1 - rows / samples <= options.limits.max_missing;
}

/// At each sample the last finite value so far, or the first one if none has come yet. NaN if
/// there is none at all.
Eigen::VectorXd heldCovariate(const std::vector<double>& values, const SampleGrid& grid) {
  Eigen::VectorXd held(grid.slots.back() + 1);
  const auto first =
      std::find_if(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  double current = first == values.end() ? std::nan("") : *first;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) current = values[i];
    const long next = i + 1 < values.size() ? grid.slots[i + 1] : grid.slots[i] + 1;
    for (long k = grid.slots[i]; k < next; ++k) held(k) = current;
  }
  return held;
}

Experiment onGrid(const CsvTable& table, const SampleGrid& grid, const Configuration& options) {
  const auto samples = static_cast<Eigen::Index>(grid.slots.back()) + 1;
  Experiment experiment;
  experiment.id = table.id;
  experiment.sample_time = options.sample_time > 0 ? options.sample_time : grid.period;
  experiment.start_time = grid.origin;
  experiment.u.resize(samples);
  experiment.y = Eigen::VectorXd::Zero(samples);
  std::vector<std::uint8_t> valid(static_cast<std::size_t>(samples), 0);
  Eigen::VectorXd offsets = Eigen::VectorXd::Zero(samples);
  for (std::size_t i = 0; i < table.t.size(); ++i) {
    const long slot = grid.slots[i];
    const long next = i + 1 < table.t.size() ? grid.slots[i + 1] : slot + 1;
    for (long k = slot; k < next; ++k) experiment.u(k) = table.u[i];
    offsets(slot) = table.t[i] - grid.instant(i);
    if (std::isnan(table.y[i])) continue;
    experiment.y(slot) = table.y[i];
    valid[static_cast<std::size_t>(slot)] = 1;
  }
  if (std::count(valid.begin(), valid.end(), 0) > 0) experiment.valid = std::move(valid);
  if (grid.max_departure > kNoticeable * grid.period) experiment.stamp_offset = std::move(offsets);
  return experiment;
}

void addOnGrid(CsvTable& table, const CsvFile& file, const SampleGrid& grid,
               const Configuration& options, LoadedData& data) {
  const std::string false_readings = replaceFalseReadings(table.t, &table.u, table.t, &table.y);
  if (!false_readings.empty()) data.warnings.push_back(named(table.id) + ": " + false_readings);
  Experiment experiment = onGrid(table, grid, options);
  for (std::size_t c = 0; c < file.covariate_names.size(); ++c) {
    Eigen::VectorXd values = heldCovariate(table.covariates[c], grid);
    if (values.array().isFinite().all())
      addCovariate(file.covariate_names[c], std::move(values), experiment);
  }
  const auto left_out = experiment.samples() - static_cast<long>(table.t.size());
  if (left_out > 0) {
    data.warnings.push_back(
        named(table.id) + ": " + std::to_string(left_out) +
        " rows are missing between the stamps; their outputs count as missing, and the input is "
        "taken to have kept its value; record without gaps");
  }
  data.experiments.push_back(std::move(experiment));
}

Recording asRecording(const CsvTable& table, const CsvFile& file) {
  Recording recording;
  recording.id = table.id;
  for (std::size_t i = 0; i < table.t.size(); ++i) {
    if (!std::isnan(table.u[i]) || table.rows_without_input == 0) {
      recording.input.stamps.push_back(table.t[i]);
      recording.input.values.push_back(table.u[i]);
    }
    if (std::isnan(table.y[i])) continue;
    recording.output.stamps.push_back(table.t[i]);
    recording.output.values.push_back(table.y[i]);
  }
  for (std::size_t c = 0; c < file.covariate_names.size(); ++c) {
    recording.covariates[file.covariate_names[c]] = {table.t, table.covariates[c]};
  }
  return recording;
}

/// Tells how many outputs are missing. Where input and output have rows of their own, an empty cell
/// is no missing output.
void tellMissing(const CsvTable& table, LoadedData& data) {
  const long empty = table.rows_without_input > 0 ? 0 : table.empty_outputs;
  const long missing = table.bad_outputs + empty;
  if (missing == 0) return;
  std::string kinds =
      table.bad_outputs > 0 ? std::to_string(table.bad_outputs) + " NaN or infinite" : "";
  if (empty > 0) kinds += (kinds.empty() ? "" : ", ") + std::to_string(empty) + " empty";
  data.warnings.push_back(named(table.id) + ": " + std::to_string(missing) + " of " +
                          std::to_string(table.y.size()) + " outputs are no numbers (" + kinds +
                          ") and count as missing");
}

void addTable(CsvTable& table, CsvFile& file, const Configuration& configuration,
              LoadedData& data) {
  const SampleGrid grid = fitSampleGrid(table.t);
  warnOfTime(file, table, grid.period, data);
  if (table.rows_without_input > 0)
    data.warnings.push_back(named(table.id) + ": " + std::to_string(table.rows_without_input) +
                            " of " + std::to_string(table.t.size()) +
                            " rows have no input, which is held between the others");
  tellMissing(table, data);
  if (const auto division = divisionOf(table, grid.period, configuration, data))
    addDivided(table, file, *division, configuration, data);
  else if (table.rows_without_input == 0 && fitsGrid(grid, configuration))
    addOnGrid(table, file, grid, configuration, data);
  else
    addResampled(asRecording(table, file), configuration.sample_time, configuration.resampling,
                 data);
}

/// Why the experiment cannot be used; empty if it can.
std::string problemOf(const CsvTable& table, const CsvFile& file) {
  if (!table.problem.empty() || table.t.size() > 1) return table.problem;
  return file.path + ", line " + std::to_string(table.first_line) +
         ": the experiment has one sample; record a longer one";
}

}  // namespace

LoadedData readCsv(const std::string& path, const Configuration& configuration) {
  CsvFile file = parseCsv(path, configuration);
  LoadedData data;
  if (!file.remarks.empty()) data.warnings.push_back(assumptions(file));
  for (CsvTable& table : file.tables) {
    const std::string problem = problemOf(table, file);
    const std::size_t first = data.experiments.size();
    if (problem.empty())
      addTable(table, file, configuration, data);
    else
      data.rejected.push_back({table.id, named(table.id) + ": " + problem});
    for (std::size_t i = first; i < data.experiments.size(); ++i)
      data.experiments[i].start_time += table.start;
    table = CsvTable();  // frees the rows, so that a large file is not in memory twice
  }
  return data;
}

}  // namespace uncertainty_identification
