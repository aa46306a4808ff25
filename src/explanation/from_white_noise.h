#pragma once

#include <vector>

#include "explanation/fitted_effect.h"

namespace uncertainty_identification {

/// What of `effects` leads somewhere from white noise that it may not from `base`'s noise model,
/// scored over `base`:
///  - a further pair of noise poles: the declared poles may have taken its place, and no climb
///    leads on from there;
///  - where a noise pole and a zero are so near the unit circle that they hold what does not die
///    out, a bias, a drift or a hum, the most promising of all effects: none of those shows beside.
/// Nothing where the model has no noise poles of its own.
std::vector<FittedEffect> fittedFromWhiteNoise(const Fit& base, const FitData& data,
                                               const Effects& effects, const FitContext& context);

}  // namespace uncertainty_identification
