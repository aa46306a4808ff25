#pragma once

#include "curves/curve_search.h"
#include "curves/plant_orders.h"

namespace uncertainty_identification {

/// The search that ends better if another place than the best's comes first, or the best itself.
/// The first place is chosen before the causes beside it are known, with which another one may
/// explain as much or more: such places are told as ties.
CurveSearchResult comparedWithRivals(CurveSearchResult best, const SimulationData& data,
                                     const SimulationData& held, const LinearPlants& linear,
                                     const CurveSearchLimits& limits,
                                     const CurveSearchContext& context);

}  // namespace uncertainty_identification
