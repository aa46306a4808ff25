#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "own_simulation/change_fit.h"

namespace uncertainty_identification {

/// A change that was accepted.
struct FoundChange {
  Change change;
  std::vector<Change> ties;  ///< explain the data as well
  /// Squared error of held-out data with all other changes, fitted anew; infinite where there were
  /// no runs left for it.
  double held_without = std::numeric_limits<double>::infinity();
};

struct ChangeSearchLimits {
  int max_causes = 4;
  double least_gain = 0.05;   ///< of the squared error: units left out, and held out
  double least_own = 0.2;     ///< the same of a transient, which is fitted to each experiment
  double least_t = 3;         ///< paired, over units; also of the change's own size
  double least_clear_t = 5;   ///< of the size; units left out then need no more than least_held_t
  double least_held_t = 1.7;  ///< paired, over held-out units: 95 %, one-sided
  std::function<void(const std::string&)> tell;  ///< what is being done; may be empty
};

struct ChangeSearchResult {
  std::vector<FoundChange> found;           ///< the largest gain on held-out data first
  ChangeFit fit;                            ///< with the changes of `found`, in that order
  Eigen::VectorXd held_before, held_after;  ///< squared errors of the held-out units
};

/// Looks for what is wrong with a simulation in a forward selection with backward elimination:
/// parameters and what can be done to any output compete. `held` decides about what is accepted.
ChangeSearchResult searchChanges(const ChangedSimulation& simulation, const ComparedData& fitted,
                                 const ComparedData& held, const ChangeSearchLimits& limits);

}  // namespace uncertainty_identification
