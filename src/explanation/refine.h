#pragma once

#include <functional>

#include "explanation/fit.h"
#include "math/worker_pool.h"

namespace uncertainty_identification {

/// What fits share: options of an optimisation, the seed of the mixture's restarts, threads, and
/// whether to go on.
struct FitContext {
  OptimisationOptions options;
  std::uint64_t seed = 1;
  WorkerPool* pool = nullptr;
  std::function<bool()> going_on;  ///< may be called from any thread
  std::function<void(double)>
      report_searched;  ///< called with the share of the search that is done, 0 to 1
};

/// To convergence from where it is.
Fit optimise(Fit fit, const FitData& data, const FitContext& context);

/// To convergence, from new starts of theta (`anew`) and of the mixture too: what further
/// iterations gain must not count for a candidate.
Fit optimiseWithRestarts(Fit fit, const FitData& data, const FitContext& context, bool anew = true);

/// Zooming search along the parameters that the likelihood has no useful derivative to.
Fit searchGrid(Fit fit, const FitData& data, const FitContext& context);

/// Theta and mixture started anew, given psi; kept if that leads higher.
Fit withNewStart(const Fit& fit, const FitData& data, const FitContext& context, int steps);

/// Theta and psi as they are with another mixture, grown from one component.
Fit withNewMixture(const Fit& fit, const FitData& data, const FitContext& context, int components,
                   int restarts);

/// Whether theta may lie far from where it was without the effect.
bool movesPlant(const Effect& effect);

}  // namespace uncertainty_identification
