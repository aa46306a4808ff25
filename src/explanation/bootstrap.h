#pragma once

#include "explanation/candidates.h"

namespace uncertainty_identification {

/// A parametric bootstrap test for one more mixture component. True if `ratio`, the gain of
/// log-likelihood [nats] by the component, exceeds those of all data sets simulated from `base`,
/// which lacks it. The simulation is needed because the likelihood ratio of mixtures is not
/// chi-squared distributed. It draws sufficient statistics instead of samples, which has the same
/// effect.
bool exceedsSimulatedRatios(const Fit& base, const FitData& data, const FitContext& context,
                            double ratio);

}  // namespace uncertainty_identification
