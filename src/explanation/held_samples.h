#pragma once

#include <vector>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

constexpr int kFewestRepeats = 4;  ///< exact repeats; fewer may happen by chance

/// Whether sample t lies strictly between the extremes and repeats the sample before.
bool isHeld(const Experiment& experiment, int t, double low, double high);

/// Share of the samples that the sensor holds; `sorted` are all measured values. 0 where so few
/// samples repeat the one before that this may be chance, where values are repeated apart in time
/// or by few steps, which is coarse resolution, or where the machine stands still.
double heldShare(const std::vector<Experiment>& experiments, const std::vector<double>& sorted);

}  // namespace uncertainty_identification
