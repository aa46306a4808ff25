#pragma once

#include <vector>

#include "explanation/fitted_effect.h"

namespace uncertainty_identification {

/// All effects of `effects` on top of `base`, best score first: screened, the promising ones
/// fitted, the best to convergence. Where nothing shows that anything is wrong, an effect is
/// promising only if its screening says so.
std::vector<FittedEffect> fittedEffects(const Fit& base, const FitData& data,
                                        const Effects& effects, const FitContext& context,
                                        bool nothing_shows);

/// One component more, if the mixture's likelihood ratio exceeds all of those simulated without it.
FittedEffect oneMoreComponent(const Fit& base, const FitData& data,
                              const std::shared_ptr<const Effect>& effect,
                              const FitContext& context);

}  // namespace uncertainty_identification
