#pragma once

#include <string>
#include <vector>

#include "explanation/split.h"

namespace uncertainty_identification {

/// Leaves out the covariates, other than those that the configuration states, that belong to the
/// loop around the plant; a sentence for each kind. As a second input such a signal would explain
/// the output by itself.
/// Another reading of the machine (its speed beside its position), or what a controller makes of
/// the output: the output tells its changes, up to the same sample, beyond what its own last
/// changes tell; a disturbance moves before the output does.
/// The setpoint of a controller: the input is computed from it and the output.
std::vector<std::string> leaveOutColumnsOfTheLoop(const Configuration& configuration, Split* data);

}  // namespace uncertainty_identification
