#pragma once

#include "refine.h"
#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// Where the orders were chosen from the data (nominal_model.orders: auto in `asked`): the estimate
/// with as many more poles as the likelihood of all experiments asks for by BIC. The choice rests
/// on simulations, beside whose errors, the plants' spread, small dynamics do not show; to the
/// search for causes they would look like a lag or resonance that somebody forgot.
Estimate withOrdersAskedFor(const Configuration& asked, Estimate estimate,
                            const std::vector<Experiment>& experiments, const FitContext& context,
                            const ProgressCallback& progress);

}  // namespace uncertainty_identification
