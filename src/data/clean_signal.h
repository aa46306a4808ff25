#pragma once

#include <string>
#include <vector>

#include "data/sample_grid.h"
#include "uncertainty_identification/data/recording.h"

namespace uncertainty_identification {

/// A signal ready for resampling: its stamps rise strictly, and the grid on which they lie is
/// known.
struct CleanSignal {
  std::vector<double> stamps;  ///< [s] as received
  std::vector<double>
      instants;  ///< [s] nominal sampling instants: the stamps without jitter, see removeJitter
  std::vector<double> values;
  SampleGrid grid;
  int duplicate_stamps = 0, zero_stamps = 0, stray_stamps = 0;
  bool on_grid = false;  ///< set by removeJitter: the stamps belong to a grid whose period is about
                         ///< the sample time, or shorter

  /// Index of the newest sample whose instant is not after `time` [s]; -1 if there is none.
  std::ptrdiff_t newestAt(double time) const;

  /// Moves the instants of jittering stamps to the grid, provided that its period is about the
  /// sample time or shorter, so that no sample moves by more than half a sample time.
  void removeJitter(double sample_time);
};

/// The places of the stamps [s] of one signal that do not stray (StampGate), in order.
std::vector<std::size_t> withoutStrays(const std::vector<double>& stamps);

/// Leaves out stray stamps (StampGate), duplicates and stamps outside [start, end) (if end <=
/// start, none is outside) and fits the grid. `role` names the signal in messages. Throws DataError
/// for backward or non-finite stamps and for a signal without samples.
CleanSignal cleanSignal(const StampedSignal& signal, const std::string& experiment,
                        const std::string& role, Duplicates keep, double start = 0, double end = 0);

}  // namespace uncertainty_identification
