#pragma once

#include <string>
#include <vector>

#include "curves/curve_search.h"
#include "uncertainty_identification/curves/simulation_causes.h"

namespace uncertainty_identification {

/// The name of a cause, such as "act_deadzone" for a dead zone of the input.
std::string causeNamed(Place place, const std::string& shape);

/// All names that causeNamed() gives, and that of dead time.
std::vector<std::string> curveCauseNames();

/// A cause in words and numbers, with its curve in the units of the data.
SimulationCause describeCurve(const FoundCurve& found, const SimulationFit& fit,
                              const SimulationData& data);

}  // namespace uncertainty_identification
