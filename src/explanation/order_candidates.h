#pragma once

#include "explanation/refine.h"
#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// The models that causes may be looked for on top of. With the orders told, the estimate alone.
/// Where they were chosen from the data (nominal_model.orders: auto in `asked`), they were chosen
/// by simulations, beside whose errors, the plants' spread, small dynamics do not show; to the
/// search for causes they would look like a lag or resonance that somebody forgot. Then, all by
/// likelihood:
///  - first the orders chosen, with as much more of the plant as BIC asks for, and without what it
///    does not miss of the noise model;
///  - where the plant grew by that, the one chosen with the same orders of the noise model;
///  - the first without the noise model's poles that are so near the unit circle that they hold
///    what does not die out: a bias, a drift or a hum.
std::vector<Estimate> orderCandidates(const Configuration& asked, const Estimate& estimate,
                                      const std::vector<Experiment>& experiments,
                                      const FitContext& context, const ProgressCallback& progress);

}  // namespace uncertainty_identification
