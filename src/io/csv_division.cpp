#include "io/csv_division.h"

#include <algorithm>
#include <cmath>

#include "data/experiment_cutter.h"
#include "data/text.h"

namespace uncertainty_identification {
namespace {

constexpr double kPause = 20;        // [sample times] a longer silence is a pause of the logger
constexpr double kRegularly = 0.9;   // share of the steps that are about a sample time
constexpr std::size_t kPrefix = 10;  // length of "experiment", with which the cutter's ids begin

struct Pauses {
  long count = 0;
  double first = 0, longest = 0;  // [s] stamp before the first one; length
};

/// The pauses of a logger that otherwise writes regularly.
Pauses pausesOf(const std::vector<double>& stamps, double period) {
  Pauses pauses;
  long regular = 0;
  for (std::size_t i = 0; i + 1 < stamps.size(); ++i) {
    const double step = stamps[i + 1] - stamps[i];
    if (step > 0.5 * period && step < 1.5 * period) ++regular;
    if (step <= kPause * period) continue;
    if (pauses.count++ == 0) pauses.first = stamps[i];
    pauses.longest = std::max(pauses.longest, step);
  }
  const bool regularly =
      static_cast<double>(regular) > kRegularly * static_cast<double>(stamps.size() - 1);
  return regularly ? pauses : Pauses();
}

void tellOf(const Pauses& pauses, const CsvTable& table, LoadedData& data) {
  data.warnings.push_back(
      named(table.id) + ": the stamps pause " + std::to_string(pauses.count) +
      (pauses.count == 1 ? " time, for " : " times, for up to ") + rounded(pauses.longest) +
      " s, first after " + text(pauses.first) +
      " s; it was divided there, because the input in a pause is not known; experiment: {mode: "
      "gap, gap: SECONDS} divides at other silences");
}

void fill(ExperimentCutter& cutter, const CsvTable& table, const CsvFile& file) {
  for (std::size_t i = 0; i < table.t.size(); ++i) {
    const double t = table.t[i];
    if (!table.markers.empty() && table.markers[i] >= 0) cutter.addMarker(t, table.markers[i] > 0);
    if (!std::isnan(table.u[i])) cutter.addInput(t, table.u[i]);
    for (std::size_t c = 0; c < file.covariate_names.size(); ++c)
      if (!std::isnan(table.covariates[c][i]))
        cutter.addCovariate(file.covariate_names[c], t, table.covariates[c][i]);
    if (!std::isnan(table.y[i])) cutter.addOutput(t, table.y[i]);
  }
  cutter.flush();
}

}  // namespace

std::optional<ExperimentOptions> divisionOf(const CsvTable& table, double period,
                                            const Configuration& configuration, LoadedData& data) {
  const ExperimentOptions& options = configuration.experiment;
  if (options.mode == ExperimentMode::duration || options.mode == ExperimentMode::gap)
    return options;
  if (options.mode == ExperimentMode::topic && !table.markers.empty()) return options;
  const Pauses pauses = pausesOf(table.t, period);
  if (pauses.count == 0) return std::nullopt;
  tellOf(pauses, table, data);
  ExperimentOptions at_pauses;
  at_pauses.mode = ExperimentMode::gap;
  at_pauses.gap = kPause * period;
  return at_pauses;
}

void addDivided(const CsvTable& table, const CsvFile& file, const ExperimentOptions& division,
                const Configuration& configuration, LoadedData& data) {
  ExperimentCutter cutter(division, configuration.limits);
  fill(cutter, table, file);
  std::vector<Recording> recordings = cutter.takeFinished();
  if (recordings.empty())
    data.rejected.push_back({table.id, named(table.id) + ": " + file.path +
                                           " holds no experiment; check experiment.mode and, in "
                                           "mode topic, the column that marks experiments"});
  for (Recording& recording : recordings) {
    recording.id = table.id + recording.id.substr(kPrefix);
    addResampled(recording, configuration.sample_time, configuration.resampling, data);
  }
}

}  // namespace uncertainty_identification
