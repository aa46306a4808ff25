#include "data/clean_signal.h"

#include <algorithm>
#include <cmath>

#include "data/text.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

[[noreturn]] void refuse(const std::string& experiment, const std::string& role,
                         const std::string& what) {
  throw DataError(named(experiment) + ": " + role + " " + what);
}

void checkStamp(const StampedSignal& signal, std::size_t i, const std::string& experiment,
                const std::string& role) {
  const double stamp = signal.stamps[i];
  if (!std::isfinite(stamp)) {
    refuse(experiment, role,
           "has the stamp " + text(stamp) + " s at sample " + std::to_string(i) +
               "; record finite stamps");
  }
  if (i > 0 && stamp < signal.stamps[i - 1]) {
    refuse(experiment, role,
           "stamps go back from " + text(signal.stamps[i - 1]) + " s to " + text(stamp) +
               " s at sample " + std::to_string(i) +
               "; use one clock for all stamps, and start a new experiment when it is reset");
  }
}

}  // namespace

std::ptrdiff_t CleanSignal::newestAt(double time) const {
  return std::upper_bound(instants.begin(), instants.end(), time) - instants.begin() - 1;
}

void CleanSignal::removeJitter(double sample_time) {
  on_grid = stamps.size() > 2 && grid.one_to_one && grid.period <= 1.5 * sample_time &&
            grid.max_departure <= 0.5 * sample_time;
  if (!on_grid || grid.max_departure <= stampTolerance(stamps.back(), sample_time)) return;
  for (std::size_t i = 0; i < stamps.size(); ++i) instants[i] = grid.instant(i);
}

CleanSignal cleanSignal(const StampedSignal& signal, const std::string& experiment,
                        const std::string& role, Duplicates keep, double start, double end) {
  if (signal.stamps.size() != signal.values.size()) {
    refuse(experiment, role,
           "has " + std::to_string(signal.stamps.size()) + " stamps for " +
               std::to_string(signal.values.size()) + " values; give one stamp per value");
  }
  CleanSignal clean;
  for (std::size_t i = 0; i < signal.stamps.size(); ++i) {
    checkStamp(signal, i, experiment, role);
    const double stamp = signal.stamps[i];
    if (end > start && (stamp < start || stamp >= end)) continue;
    if (stamp == 0) ++clean.zero_stamps;
    if (!clean.stamps.empty() && stamp == clean.stamps.back()) {
      ++clean.duplicate_stamps;
      if (keep == Duplicates::keep_last) clean.values.back() = signal.values[i];
      continue;
    }
    clean.stamps.push_back(stamp);
    clean.values.push_back(signal.values[i]);
  }
  if (clean.stamps.empty()) {
    refuse(
        experiment, role,
        "has no samples between the start and the end of the experiment; check that its topic is "
        "recorded and that its stamps come from the same clock as the others");
  }
  clean.grid = fitSampleGrid(clean.stamps);
  clean.instants = clean.stamps;
  return clean;
}

}  // namespace uncertainty_identification
