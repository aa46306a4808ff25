#pragma once

#include <cstddef>
#include <vector>

namespace uncertainty_identification {

/// The uniform grid around which the stamps of a periodic signal scatter: without jitter, stamp i
/// would be origin + slots[i] period.
struct SampleGrid {
  double origin = 0;             ///< [s] instant of slot 0: the first stamp, or the median phase
  double period = 0;             ///< [s] between slots; 0 for fewer than two stamps
  std::vector<long> slots;       ///< slot of each stamp; a gap skips slots
  double max_departure = 0;      ///< [s] largest distance of a stamp from its slot (its jitter)
  double typical_departure = 0;  ///< [s] median distance
  bool one_to_one = false;       ///< each stamp has its own slot and is nearer to it than to others

  /// [s] stamp i without its jitter.
  double instant(std::size_t i) const { return origin + static_cast<double>(slots[i]) * period; }
};

/// Fits a grid to strictly rising stamps [s]. The period is the median spacing, refined by a
/// straight line through stamps over slots and rounded to the shortest decimal number that moves no
/// slot by more than the jitter: 0.01 s for a 100 Hz signal however its stamps are rounded. Jitter
/// up to a fifth of the period and a tenth of the samples lost are found reliably. Stamps that
/// follow no grid (one_to_one false) keep the plain median spacing.
SampleGrid fitSampleGrid(const std::vector<double>& stamps);

/// [s] the largest difference of two stamps that count as the same instant: 1e-6 of the sample
/// time, but at least the resolution of a double at that stamp (2.4e-7 s for seconds since 1970).
double stampTolerance(double stamp, double sample_time);

}  // namespace uncertainty_identification
