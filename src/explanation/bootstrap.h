#pragma once

#include "explanation/candidates.h"

namespace uncertainty_identification {

/// Whether a log-likelihood ratio [nats] of one component more exceeds all those that data
/// simulated from `base`, without it, give: the ratio of mixtures has no chi-squared law. The
/// simulation is that of the sufficient statistics: no sample is drawn.
bool exceedsSimulatedRatios(const Fit& base, const FitData& data, const FitContext& context,
                            double ratio);

}  // namespace uncertainty_identification
