#pragma once

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// How often the output jumps from one end of its range to the other against the motion before and
/// after, as an angle does that goes on at 0 after 360 degrees. 0 where it is fewer than three
/// times, or where other jumps are as large.
int wrapsOf(const Experiment& experiment);

}  // namespace uncertainty_identification
