#pragma once

#include <vector>

#include "explanation/fitted_effect.h"

/// Which effects would explain the data on top of a fit.
namespace uncertainty_identification {

/// Fits the effects of the catalogue `effects`, each alone on top of `base`, and returns them with
/// the best score first. All are screened, those of a promising screening score are fitted by a few
/// steps, and the best of these to convergence. `checks_pass`: the residual checks of `base` find
/// nothing wrong; an effect then needs a better screening score to be fitted.
std::vector<FittedEffect> fittedEffects(const Fit& base, const FitData& data,
                                        const Effects& effects, const FitContext& context,
                                        bool checks_pass);

/// The base with one mixture component more, as a candidate for `effect` (exp_mode). Its penalty is
/// that of BIC, each experiment being one observation, and a constant for the choice among many
/// ways to split the mixture. The score is -infinity where the experiments are too few, or where
/// the fit gives a component less than two of them. Whether the likelihood ratio is significant is
/// another question, which exceedsSimulatedRatios() answers.
FittedEffect oneMoreComponent(const Fit& base, const FitData& data,
                              const std::shared_ptr<const Effect>& effect,
                              const FitContext& context);

}  // namespace uncertainty_identification
