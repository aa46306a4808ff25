#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/data/recording.h"
#include "uncertainty_identification/data/rejected_experiment.h"

namespace uncertainty_identification {

/// The experiments that a file holds. Bad ones are listed, and the others are kept.
struct LoadedData {
  std::vector<Experiment> experiments;
  std::vector<RejectedExperiment> rejected;
  std::vector<std::string> warnings;
};

/// Replaces false readings of a recording (data/false_readings.h), resamples it and adds it to
/// `data`: to the experiments, or to the rejected ones with
/// the reason. With sample_time 0, a recording whose sample time is that of the first experiment
/// within two per cent, the accuracy under jitter, gets that one; any other keeps its own. `first`
/// is the sample time [s] of the first experiment if that is not in `data`; 0: it is.
void addResampled(Recording recording, double sample_time, const ResamplingOptions& options,
                  LoadedData& data, double first = 0);

/// The sample time [s] to which experiments must be resampled so that at least four fifths of them
/// can be used together: the longest, or the middle one where they are the same within two per
/// cent. 0 where they are equal to 1e-3, or differ by more than a factor of 30, which is a mistake
/// rather than another logger. Experiments that are slower are left to be rejected by the checks.
double sampleTimeForAll(const std::vector<Experiment>& experiments);

/// Appends the contents of `more` to those of `data`.
void append(LoadedData more, LoadedData& data);

}  // namespace uncertainty_identification
