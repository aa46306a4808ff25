#pragma once

#include <optional>
#include <string>
#include <vector>

#include "session/experiment_set.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {

/// Adds what a person wants to see of a result first: the plant in physical numbers, and runs to
/// look at, without prediction intervals, which need many identifications. `kept` are the
/// experiments of the node; those that the estimate did not use are passed over.
void addOverview(const std::vector<KeptExperiment>& kept, Result* result);

/// The number of this name. Of several numbered ones the first, which is the slowest pole's; absent
/// if there is none.
std::optional<PhysicalNumber> findNumber(const PhysicalNumbers& physical, const std::string& name);

/// The simulation fit [%] of the median run; of the first where there are fewer than three; NaN
/// where there is none.
double typicalFit(const std::vector<SimulatedRun>& runs);

}  // namespace uncertainty_identification
