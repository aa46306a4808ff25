#pragma once

#include <functional>
#include <string>
#include <vector>

#include "curves/search_context.h"

namespace uncertainty_identification {

/// A place, with the covariate that it reads.
struct PlaceOf {
  Place place = Place::input;
  std::string covariate;
};

/// Whether a plant comes to rest at a value that depends on the input, as a loop that follows the
/// input does.
bool comesToRest(const CurveModel& model);

/// The model of `fit` with a free curve at `place`, zero, or with a width or limit of `width`.
CurveModel extended(const SimulationData& data, const WindowFit& fit, const PlaceOf& place,
                    double width = 0);

/// The linearised fit of every place that the model does not have yet and that is not excluded, the
/// best first.
struct ScreenedPlace {
  PlaceOf place;
  WindowFit fit;
};
std::vector<ScreenedPlace> screenPlaces(const SimulationData& data, const WindowFit& fit,
                                        const std::function<bool(Place)>& excluded,
                                        const CurveSearchContext& context);

/// The free curve of a screened place fitted fully: from zero, from the linearised step and from
/// 0.4 of it.
WindowFit fitPlace(const SimulationData& data, const WindowFit& before,
                   const ScreenedPlace& screened, const CurveSearchContext& context);

}  // namespace uncertainty_identification
