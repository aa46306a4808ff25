#pragma once

#include <functional>
#include <vector>

#include "explanation/refine.h"

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

/// All effects where the screening puts them, the most promising first.
std::vector<FittedEffect> screenedEffects(const Fit& base, const FitData& data,
                                          const Effects& effects, const FitContext& context);

/// The candidate at its start, or moved by the predicted step or part of it, psi within its bounds:
/// a gain of the wrong sign would not be climbed away from.
Fit afterPredictedStep(const FittedEffect& candidate, const FitData& data,
                       const FitContext& context);

/// Climbs on from `fit`, `anew` from new starts of theta and mixture too, and scores over `base`.
void converge(FittedEffect* candidate, Fit fit, const Fit& base, const FitData& data,
              const FitContext& context, int steps, bool anew);

/// The best of a few steps from all starts of the effect, the model's parameters `from`: where the
/// likelihood has many maxima that the screening does not see.
FittedEffect fittedFromEachStart(const FittedEffect& screened, const ModelParameters& from,
                                 const Fit& base, const FitData& data, const FitContext& context);

/// Best first.
void sortByScore(std::vector<FittedEffect>* candidates);

/// Tasks 0 to count - 1 by the threads of the context, until it is not to go on.
void inParallel(const FitContext& context, std::size_t count,
                const std::function<void(std::size_t)>& task);

/// Whether an effect is one of the noise: a symptom of whatever else is wrong.
bool isOfNoise(const Effect& effect);

/// Whether an effect is one of the mixture: about a nat per experiment, whatever their length.
bool isOfMixture(const Effect& effect);

}  // namespace uncertainty_identification
