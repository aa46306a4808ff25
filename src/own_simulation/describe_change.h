#pragma once

#include <vector>

#include "own_simulation/change_search.h"
#include "uncertainty_identification/own_simulation/findings.h"

namespace uncertainty_identification {

/// The causes in words and in the units of the data. `spreads` are of the coordinates of
/// result.fit; `sample_time` [s].
std::vector<OwnCause> describeChanges(const ChangeSearchResult& result,
                                      const std::vector<RunSpread>& spreads,
                                      const ChangedSimulation& simulation, const ComparedData& data,
                                      const ComparedData& held, double sample_time);

/// What a factor between measured and simulated looks like, such as degrees for radians; empty
/// where it looks like none that is known.
std::string likelyUnit(double factor);

}  // namespace uncertainty_identification
