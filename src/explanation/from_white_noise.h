#pragma once

#include <vector>

#include "explanation/fitted_effect.h"

namespace uncertainty_identification {

/// Fits effects on top of `base` with its noise model reset to white noise, where a fit that starts
/// from the noise model of `base` may end in a local optimum. Scores are over `base`, as those of
/// fittedEffects(). The effects are:
///  - a further pair of noise poles (noise_colour): the declared noise poles may have moved to the
///    place of the missing pair, and an optimisation does not move them back;
///  - the most promising of all effects, if a pole and a zero of the noise model are so near the
///    unit circle that they describe a bias, a drift or a hum. With such a noise model none of
///    these effects would gain anything.
/// Empty where the model has no noise poles of its own.
std::vector<FittedEffect> fittedFromWhiteNoise(const Fit& base, const FitData& data,
                                               const Effects& effects, const FitContext& context);

}  // namespace uncertainty_identification
