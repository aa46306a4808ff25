#pragma once

#include <vector>

#include "explanation/fitted_effect.h"
#include "explanation/search.h"

/// How probable a cause is among the effects that were tried.
namespace uncertainty_identification {

/// What all experiments, those fitted to and those held out, say for an effect.
struct Evidence {
  double score = 0;       ///< [nats] gain of log density in all experiments, minus the penalty
  Eigen::VectorXd gains;  ///< [nats] of each experiment; empty where it is not known
};

/// Posterior probability of the chosen effect among the rivals, all equally probable before:
/// exp(score) over the sum of exp(score) of all. The models are approximations, so that scores
/// differ by more than the experiments support: an effect is no more probable than a rival by more
/// than the odds Phi(z) : Phi(-z), where z is the difference of scores over the standard error that
/// the differences of the experiments give. Fewer than four experiments do not show how far they
/// agree: no probability is above 80 % then.
double confidenceOf(const Evidence& chosen, const std::vector<Evidence>& rivals);

/// The same for a candidate whose final fit is `fit`, among those of `ranked` that are other
/// effects.
double confidenceFor(const SearchState& state, const FittedEffect& chosen, const Fit& fit,
                     const std::vector<FittedEffect>& ranked);

}  // namespace uncertainty_identification
