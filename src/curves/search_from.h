#pragma once

#include "curves/curve_search.h"
#include "curves/plant_orders.h"

namespace uncertainty_identification {

/// Looks for curves on top of one linear plant. The `linear` plants of other orders compete with
/// them; `held` decides about what is accepted.
CurveSearchResult searchFrom(const WindowFit& base, const SimulationData& data,
                             const SimulationData& held, const LinearPlants& linear,
                             const CurveSearchLimits& limits, const CurveSearchContext& context);

/// The same with another first cause, one of the choice's others; without causes where this one
/// does not convince. Places of `limits` that are excluded are not tried beside it.
CurveSearchResult searchBehind(const CurveCandidate& first, const FirstChoice& choice,
                               const WindowFit& base, const SimulationData& data,
                               const SimulationData& held, const LinearPlants& linear,
                               const CurveSearchLimits& limits, const CurveSearchContext& context);

}  // namespace uncertainty_identification
