#pragma once

#include "explanation/refine.h"
#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// The models on top of which causes are looked for. If the configuration `asked` states the
/// orders, this is the estimate alone.
///
/// With nominal_model.orders: auto the orders were chosen by the error of simulations. As the
/// spread of the plants dominates that error, it does not show small dynamics, and the search for
/// causes would take these for a forgotten lag or resonance. The models returned are therefore
/// chosen by likelihood:
///  - first, the estimate with the orders of the plant raised and those of the noise model lowered
///    as long as BIC improves;
///  - if that raised the plant's orders, the plant's orders of the estimate with the noise model's
///    orders of the first model;
///  - if noise poles of the first model lie near the unit circle, where they describe a bias, a
///    drift or a hum, the first model without them;
///  - if two plant poles of the first model oscillate and nothing damps them, the first model
///    without these.
/// Where the optimum of the likelihood simulates the data far worse than the estimate, the noise
/// model describes there what Go lacks: the estimate is then returned alone, with Go held at its
/// simulation (nominal_model.fit: simulation).
std::vector<Estimate> orderCandidates(const Configuration& asked, const Estimate& estimate,
                                      const std::vector<Experiment>& experiments,
                                      const FitContext& context, const ProgressCallback& progress);

}  // namespace uncertainty_identification
