#pragma once

#include <string>

#include "explanation/split.h"

namespace uncertainty_identification {

/// Leaves out the covariates, other than those that the configuration states, whose changes the
/// output tells, up to the same sample, beyond what their own last changes tell: another reading of
/// the machine (its speed beside its position), or what a controller makes of the output. As a
/// second input such a signal would explain the output by itself; a disturbance moves before the
/// output does. Returns what was left out and why; "": nothing.
std::string leaveOutReadingsOfTheOutput(const Configuration& configuration, Split* data);

}  // namespace uncertainty_identification
