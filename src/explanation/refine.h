#pragma once

#include <functional>
#include <string>

#include "explanation/fit.h"
#include "math/worker_pool.h"

namespace uncertainty_identification {

// theta are the parameters of the linear model, psi those of the effects (docs/notation.md).

/// What all fits of a search share: options of the optimisation, the seed of the mixture's
/// restarts, threads, and callbacks.
struct FitContext {
  OptimisationOptions options;
  std::uint64_t seed = 1;
  WorkerPool* pool = nullptr;
  std::function<bool()> going_on;  ///< false once the search is cancelled; called from any thread
  std::function<void(double)> report_searched;  ///< is told the share of the search done, 0 to 1
  /// Is told what is fitted, such as "sens_lag, 3 of 12"; called from any thread.
  std::function<void(const std::string&)> report_fitted;
};

/// Optimises all parameters from the fit's point to convergence.
Fit optimise(Fit fit, const FitData& data, const FitContext& context);

/// The same, and from new starts of the mixture and, with `restart_theta`, of theta too; the best
/// result. A fit that is compared with others should be at its global optimum: otherwise a
/// candidate on top of it gains merely because it is iterated further.
Fit optimiseWithRestarts(Fit fit, const FitData& data, const FitContext& context,
                         bool restart_theta = true);

/// Searches the parameters of the last effect that the likelihood is not smooth in, one after the
/// other, on grids that become finer around the best point.
Fit searchGrid(Fit fit, const FitData& data, const FitContext& context);

/// Fits theta and the mixture from new starts by up to `steps` scoring steps, psi starting where it
/// is. Returns the given fit if its likelihood is higher.
Fit withNewStart(const Fit& fit, const FitData& data, const FitContext& context, int steps);

/// The fit with another mixture of so many components, which is grown from a single component with
/// the best of `restarts` random starts; theta and psi are fixed.
Fit withNewMixture(const Fit& fit, const FitData& data, const FitContext& context, int components,
                   int restarts);

}  // namespace uncertainty_identification
