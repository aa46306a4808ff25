#pragma once

#include <vector>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

constexpr int kFewestRepeats = 4;  ///< exact repeats; fewer may happen by chance

/// Whether sample t lies strictly between the extremes and repeats the sample before, as one of at
/// least `in_a_row` samples that do.
bool isHeld(const Experiment& experiment, int t, double low, double high, int in_a_row = 1);

/// Share of the samples that the sensor holds; `sorted` are all measured values. 0 where so few
/// samples repeat the one before that this may be chance, where values are repeated apart in time
/// or by few steps, which is coarse resolution, or where the machine stands still.
double heldShare(const std::vector<Experiment>& experiments, const std::vector<double>& sorted);

constexpr int kOfAGap = 3;  ///< repeats in a row; a sensor of coarse steps has fewer while it moves

/// Share of the samples that are held in gaps, where readings were lost while the machine moved on,
/// be it that the sensor's resolution repeats other values, too. 0 where most rows of repeats are
/// no gaps.
double shareInGaps(const std::vector<Experiment>& experiments, double low, double high);

}  // namespace uncertainty_identification
