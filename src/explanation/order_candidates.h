#pragma once

#include "refine.h"
#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// The models that causes may be looked for on top of. With the orders told, the estimate alone.
/// Where they were chosen from the data (nominal_model.orders: auto in `asked`), they were chosen
/// by simulations, beside whose errors, the plants' spread, small dynamics do not show; to the
/// search for causes they would look like a lag or resonance that somebody forgot. Then:
///  - the orders chosen, with Go by likelihood as well if that leads higher;
///  - with as many more poles as the likelihood of all experiments asks for by BIC;
///  - without the noise model's poles that are so near the unit circle that they hold what does not
///    die out: a bias, a drift or a hum.
std::vector<Estimate> orderCandidates(const Configuration& asked, const Estimate& estimate,
                                      const std::vector<Experiment>& experiments,
                                      const FitContext& context, const ProgressCallback& progress);

}  // namespace uncertainty_identification
