#pragma once

#include <vector>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Whether the outputs of the experiments lie about levels of their own, as models of each
/// experiment by itself show: with the common level subtracted, ARX models of the sixth order
/// without a constant are worse than with one in more experiments than chance explains (chi-squared
/// test, 0.1 %). Models of all experiments together cannot tell where the plants differ much,
/// because offsets then take up what these models lack.
bool levelsDiffer(const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
