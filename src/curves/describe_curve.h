#pragma once

#include <string>
#include <vector>

#include "curves/curve_search.h"
#include "uncertainty_identification/curves/simulation_causes.h"

namespace uncertainty_identification {

/// A cause in words and numbers, with its curve in the units of the data.
SimulationCause describeCurve(const FoundCurve& found, const WindowFit& fit,
                              const SimulationData& data);

}  // namespace uncertainty_identification
