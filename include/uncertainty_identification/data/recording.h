#pragma once

#include <map>
#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// A signal as it was received: one stamp [s] and one value per message, in order of arrival.
struct StampedSignal {
  std::vector<double> stamps;  ///< [s]
  std::vector<double> values;
};

/// The raw material of one experiment: what lies between two cuts, before resampling.
struct Recording {
  std::string id;
  double start = 0, end = 0;  ///< [s] the cuts
  StampedSignal input, output;
  std::map<std::string, StampedSignal> covariates;
};

/// What resampling found about the stamps of one recording.
struct ResamplingReport {
  std::string id;
  double sample_time = 0;      ///< [s] used
  double input_period = 0, output_period = 0;  ///< [s] median spacing of the stamps
  double max_jitter = 0;       ///< [s] largest departure of output stamps from a uniform grid
  double max_age = 0;          ///< [s] oldest sample that was held
  int missing_outputs = 0;     ///< grid points without an output within max_age
  int duplicate_stamps = 0, backward_stamps = 0, zero_stamps = 0;
};

/// Puts a recording on a uniform grid: zero-order hold for u; hold, linear interpolation or bin mean for y.
/// A grid point whose newest sample is older than options.max_age is missing (y: valid = 0; u: an error unless at the
/// edges, which are trimmed). sample_time 0: the median spacing of the output's stamps.
/// Throws DataError, naming the experiment, for backward stamps, no samples in common, jitter above the limit.
Experiment resample(const Recording& recording, double sample_time, const ResamplingOptions& options,
                    ResamplingReport* report = nullptr);

}  // namespace uncertainty_identification
