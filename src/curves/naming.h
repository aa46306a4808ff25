#pragma once

#include <string>
#include <vector>

#include "curves/search_context.h"

namespace uncertainty_identification {

/// A shape that was tried for a curve.
struct OtherShape {
  std::string shape;
  double behind = 0;        ///< how much worse its criterion is than the chosen one's
  bool is_as_good = false;  ///< windows that are left out do not tell it from the chosen one
};

/// What the last curve of a model is called.
struct Naming {
  WindowFit fit;             ///< with the named shape, or with the free curve
  std::string shape;         ///< "coulomb"; "curve": no shape is as good as the free curve
  std::string nearest;       ///< of a free curve: the shape that has most of its gain
  double nearest_share = 0;  ///< share of the gain, 0 to 1
  std::vector<OtherShape> others;
};

/// Fits the shapes that come closest to the free curve, the last of free.model, and compares them
/// with it by BIC with the effective number of samples. Of shapes within 2, the first in
/// shapesAt() is named. Where the full fit of the free curve gained nothing, the shapes start from
/// `linearised`, the step of the screening, if it has one.
Naming nameCurve(const SimulationData& data, const WindowFit& before, const WindowFit& free,
                 const WindowFit& linearised, int shapes, const CurveSearchContext& context);

}  // namespace uncertainty_identification
