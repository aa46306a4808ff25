#pragma once

#include "explanation/fit.h"

namespace uncertainty_identification {

/// Looks for steps in which the actuator follows its command, wherever they begin: what rounding
/// leaves is nearly a sine of the command, whose response the residuals hold. Stores the step and
/// a level in `summary` (input_step, input_level) if the residuals gain 10 nats or more, and more
/// by rounding than by a sine; the fit of a shifted quantisation (act_quantisation) starts from
/// them. Returns whether they gain by the sine, as they do of a command that was averaged, too.
bool findInputSteps(const Residuals& residuals, const Fit& base, const FitData& data,
                    DataSummary* summary);

}  // namespace uncertainty_identification
