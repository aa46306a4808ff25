#pragma once

#include <functional>
#include <vector>

#include "explanation/refine.h"

namespace uncertainty_identification {

/// An effect that was added to a base model and fitted.
struct FittedEffect {
  std::shared_ptr<const Effect> effect;
  Fit fit;
  double penalty = 0;    ///< [nats] half of BIC's penalty, and ln of the effect's number of starts
  double score = 0;      ///< [nats] gain of log-likelihood over the base, minus the penalty
  Eigen::VectorXd step;  ///< of all parameters, by which the screening predicts the gain; or empty
  bool restarted = false;  ///< theta and the mixture were also fitted from new starts
};

/// How thoroughly converge() fits a candidate.
struct FitEffort {
  int steps = 0;             ///< scoring steps, at most
  bool restart = false;      ///< also fit theta and the mixture from new starts
  bool search_grid = false;  ///< also search those parameters on a grid that the likelihood is not
                             ///< smooth in
};

/// Screens the effects: each at the start and with the score that the screening predicts, the most
/// promising first.
std::vector<FittedEffect> screenedEffects(const Fit& base, const FitData& data,
                                          const Effects& effects, const FitContext& context);

/// The candidate's model at the best of three points: its start, and the start moved by the
/// predicted step or by a part of it, with the effect's parameters psi kept within their bounds.
/// Starting from there matters where the start has the wrong sign, which an optimisation may not
/// leave.
Fit afterPredictedStep(const FittedEffect& candidate, const FitData& data,
                       const FitContext& context);

/// Optimises from `fit` and stores the result in the candidate with its score over `base`.
void converge(FittedEffect* candidate, Fit fit, const Fit& base, const FitData& data,
              const FitContext& context, const FitEffort& effort);

/// The effect fitted by a few steps from each of its starts, the other parameters starting at
/// `from`; the best of these. For likelihoods with many local maxima, which the screening does not
/// see.
FittedEffect fittedFromEachStart(const FittedEffect& screened, const ModelParameters& from,
                                 const Fit& base, const FitData& data, const FitContext& context);

/// Sorts the candidates, the best score first.
void sortByScore(std::vector<FittedEffect>* candidates);

/// Runs the tasks 0 to count - 1 on the threads of the context. Once the search is cancelled, no
/// further task begins.
void inParallel(const FitContext& context, std::size_t count,
                const std::function<void(std::size_t)>& task);

/// Whether an effect belongs to the noise. Such an effect gains whatever is wrong, and is then only
/// a symptom.
bool isOfNoise(const Effect& effect);

/// Whether an effect belongs to the mixture. Such an effect gains about a nat per experiment,
/// however long the experiments are.
bool isOfMixture(const Effect& effect);

}  // namespace uncertainty_identification
