#pragma once

#include <optional>
#include <vector>

#include "curves/preparation.h"
#include "curves/search_context.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Experiments whose outputs are counted from levels of their own: zero points of a sensor that are
/// adjusted anew, or loads that differ from one experiment to the next. Where one bias stands for
/// all of them, a slow pole takes up the differences and hides what else is wrong.
struct LevelledRecords {
  std::vector<Experiment> fitted, held;            ///< outputs less the levels
  std::vector<double> fitted_levels, held_levels;  ///< one of each experiment [unit of y]
};

/// The experiments with their levels subtracted, which are what the simulation of a linear plant of
/// first or second order leaves as a constant of each. Absent unless there are three experiments to
/// fit to, and with levels this plant leaves less than a quarter of the squared error of held-out
/// experiments that it leaves without; where none are held out, of those fitted to.
std::optional<LevelledRecords> countedFromOwnLevels(const std::vector<Experiment>& fitted,
                                                    const std::vector<Experiment>& held,
                                                    const WindowPlan& plan,
                                                    const CurveSearchContext& context);

}  // namespace uncertainty_identification
