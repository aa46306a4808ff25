#pragma once

#include <string>

#include "uncertainty_identification/own_simulation/findings.h"

namespace uncertainty_identification {

/// What is wrong with the user's simulation, as explain prints it.
std::string ownSimulationText(const OwnSimulationFindings& findings);

}  // namespace uncertainty_identification
