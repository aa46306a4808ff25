#pragma once

#include <string>
#include <vector>

#include "explanation/fitted_effect.h"
#include "explanation/measure.h"

/// When a candidate is accepted as a cause, and what it may be confused with.
namespace uncertainty_identification {

/// What the gain of log density on the held-out experiments must be for a cause to be accepted.
/// With a single experiment, which has no standard error, it must be positive.
enum class AcceptanceRule {
  significant_gain,    ///< above zero by 1.645 standard errors: the score is too low to rely on
  any_gain,            ///< positive, however uncertain: the score is high
  no_significant_loss  ///< above -2 standard errors: effects of the mixture gain only about a nat
                       ///< per experiment, which few held-out experiments do not show
};

bool passes(const Gain& gain, AcceptanceRule rule);

/// Whether held-out experiments are simulated as well with the effect as without it, because
/// likelihood alone also rewards what makes residuals white and the simulation wrong. The squared
/// error may grow by a hundredth, which is chance where the plants differ much. Effects that move
/// the simulation only by way of theta (all but ScreeningKind::regression) may let it grow by a
/// tenth. What acts before or in the plant, is no linear dynamics and takes a fifth of the noise
/// variance away must also take a hundredth of the simulation's squared error away: otherwise it
/// stands for something in the noise. Where the fit is below 80 %, plants differ too much to say
/// so. A constant beside the model's offset must make it smaller by a twentieth: otherwise it is
/// only a better guess of the states that records begin from.
bool simulatesAsWell(const Effect& effect, const Gain& gain);

/// Whether a cause, measured again in the final model, neither loses log density significantly nor
/// lowers the fit of the simulation as above.
bool stillHolds(const Effect& effect, const Gain& gain);

/// Squared error of the simulation with a cause over that without it. NaN where either is none.
double errorRatio(const Gain& gain);

/// Whether held-out experiments speak clearly for a cause: the squared error of simulating them
/// falls by a twentieth or more, or their log density gains more than three standard errors.
bool isClear(const Gain& gain);

/// The rule for an effect whose score is `score` [nats].
AcceptanceRule acceptanceRule(const Effect& effect, double score);

/// Whether the pole of a sensor lag (Trait::differencing) lies at the upper end of its range. Such
/// a lag makes the model compare differences of the data, and so absorbs whatever drifts in them.
bool isDifferencing(const Fit& fit);

/// Whether a model of higher order or longer delay may explain the data as well as the chosen
/// candidate: it is such dynamics itself, or one of a score within a few nats is.
bool mayBeOrder(const FittedEffect& chosen, const std::vector<FittedEffect>& ranked);

/// Whether two effects are forms of one cause, which are no rivals (Trait::one_cause).
bool isFormOfOneCause(const Effect& one, const Effect& other);

/// Names of the effects that the data may not distinguish from the chosen one: those that its
/// description lists, and those of a score within a few nats. Another form of the same effect is
/// given by its label.
std::vector<std::string> equivalentOf(const FittedEffect& chosen,
                                      const std::vector<FittedEffect>& ranked);

}  // namespace uncertainty_identification
