#include "data/clean_signal.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/stamp_gate.h"
#include "data/text.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

[[noreturn]] void refuse(const std::string& experiment, const std::string& role,
                         const std::string& what) {
  throw DataError(named(experiment) + ": " + role + " " + what);
}

void checkStamp(double stamp, double before, std::size_t place, const std::string& experiment,
                const std::string& role) {
  if (!std::isfinite(stamp)) {
    refuse(experiment, role,
           "has the stamp " + text(stamp) + " s at sample " + std::to_string(place) +
               "; record finite stamps");
  }
  if (stamp < before) {
    refuse(experiment, role,
           "stamps go back from " + text(before) + " s to " + text(stamp) + " s at sample " +
               std::to_string(place) +
               "; use one clock for all stamps, and start a new experiment when it is reset");
  }
}

/// A stamp and its place in the signal.
struct PlacedStamp {
  double stamp;
  std::size_t place;
};

}  // namespace

std::vector<std::size_t> withoutStrays(const std::vector<double>& stamps) {
  StampGate<PlacedStamp> gate;
  std::vector<std::size_t> places;
  const auto take = [&places](const std::vector<PlacedStamp>& passed) {
    for (const PlacedStamp& stamp : passed) places.push_back(stamp.place);
  };
  for (std::size_t i = 0; i < stamps.size(); ++i) take(gate.pass({stamps[i], i}));
  take(gate.rest());
  return places;
}

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
  const std::vector<std::size_t> places = withoutStrays(signal.stamps);
  clean.stray_stamps = static_cast<int>(signal.stamps.size() - places.size());
  double before = -std::numeric_limits<double>::infinity();
  for (const std::size_t place : places) {
    const double stamp = signal.stamps[place];
    checkStamp(stamp, before, place, experiment, role);
    before = stamp;
    if (end > start && (stamp < start || stamp >= end)) continue;
    if (stamp == 0) ++clean.zero_stamps;
    if (!clean.stamps.empty() && stamp == clean.stamps.back()) {
      ++clean.duplicate_stamps;
      if (keep == Duplicates::keep_last) clean.values.back() = signal.values[place];
      continue;
    }
    clean.stamps.push_back(stamp);
    clean.values.push_back(signal.values[place]);
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
