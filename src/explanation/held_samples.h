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

/// Samples from `begin` to before `end` that repeat the reading before.
struct HeldRow {
  int begin = 0, end = 0;
};

/// What readings a sensor gives: between the extremes, in steps of `resolution`.
struct Readings {
  double low = 0, high = 0, resolution = 0;
};

/// The rows of three samples or more that are gaps, in which readings were lost while the machine
/// moved: it moved before and after by three steps or more a sample, and the next reading makes up
/// for about as much as these say was missed, which is at least twice either of them. A machine may
/// rest until its input changes; so the input has to change in the first half of a gap.
std::vector<HeldRow> gapsOf(const Experiment& experiment, const Readings& readings);

/// Share of the samples in gaps, for sensors whose resolution repeats other values, too. 0 where
/// there are fewer than four gaps, or most rows of three repeats or more are none.
double shareInGaps(const std::vector<Experiment>& experiments, const Readings& readings);

}  // namespace uncertainty_identification
