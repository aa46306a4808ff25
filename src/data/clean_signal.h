#pragma once

#include <string>
#include <vector>

#include "data/sample_grid.h"
#include "uncertainty_identification/data/recording.h"

namespace uncertainty_identification {

/// A signal ready for resampling: stamps strictly rising, the grid they lie on known.
struct CleanSignal {
  std::vector<double> stamps;  ///< [s] as received
  std::vector<double>
      instants;  ///< [s] when the samples were due: the stamps without jitter, see removeJitter
  std::vector<double> values;
  SampleGrid grid;
  int duplicate_stamps = 0, zero_stamps = 0;
  bool on_grid = false;  ///< set by removeJitter: the stamps belong to a grid of about the sample
                         ///< time, or finer

  /// Index of the newest sample due at or before `time` [s]; -1 if there is none.
  std::ptrdiff_t newestAt(double time) const;

  /// Sets the instants of jittering stamps to the grid's, provided that they belong to one of about
  /// the sample time or finer: no sample moves by more than half a sample time.
  void removeJitter(double sample_time);
};

/// Leaves out duplicates and stamps outside [start, end) (no limits if end <= start) and fits the
/// grid. `role` names the signal in messages. Throws DataError for backward or non-finite stamps
/// and for a signal without samples.
CleanSignal cleanSignal(const StampedSignal& signal, const std::string& experiment,
                        const std::string& role, Duplicates keep, double start = 0, double end = 0);

}  // namespace uncertainty_identification
