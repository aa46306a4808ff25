#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/data/recording.h"
#include "uncertainty_identification/data/rejected_experiment.h"

namespace uncertainty_identification {

/// What a file gave: a bad experiment is listed and loses none of the others.
struct LoadedData {
  std::vector<Experiment> experiments;
  std::vector<RejectedExperiment> rejected;
  std::vector<std::string> warnings;
};

/// Resamples a recording and adds it to `data`: to the experiments, or to the rejected ones with
/// the reason. With sample_time 0, a recording of the same rate as the first experiment (within two
/// per cent, which jitter leaves open) gets its sample time, another one keeps its own. `first` is
/// the sample time [s] of the first experiment where that is not in `data`; 0: it is.
void addResampled(const Recording& recording, double sample_time, const ResamplingOptions& options,
                  LoadedData& data, double first = 0);

/// Adds everything of `more` to `data`, in order.
void append(LoadedData more, LoadedData& data);

}  // namespace uncertainty_identification
