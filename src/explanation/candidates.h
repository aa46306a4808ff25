#pragma once

#include <vector>

#include "refine.h"

namespace uncertainty_identification {

/// An effect fitted on top of a base.
struct FittedEffect {
  std::shared_ptr<const Effect> effect;
  Fit fit;
  double penalty = 0;         ///< [nats]: BIC's, and the logarithm of the number of starts
  double score = 0;           ///< [nats] gain of likelihood less the penalty
  Eigen::VectorXd step;       ///< of the parameters, that the screening predicts the gain from
  bool started_anew = false;  ///< theta and mixture were tried from new starts
};

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

/// Whether an effect is one of the noise: a symptom of whatever else is wrong.
bool isOfNoise(const Effect& effect);

/// Whether an effect is one of the mixture: about a nat per experiment, whatever their length.
bool isOfMixture(const Effect& effect);

}  // namespace uncertainty_identification
