#pragma once

#include <Eigen/Core>

#include "curves/curve_model.h"
#include "curves/simulation_data.h"
#include "curves/window_fit.h"

namespace uncertainty_identification {

/// Squared error of each held-out window where each record may have a linear plant and an offset of
/// its own (a gain and an offset where there is one record only, or its input makes a single step),
/// and each window an initial state: nothing is left of a cause that only imitates differences
/// between records, and a curve that shows within a record remains. Empty where every input is a
/// single step, which shows nothing but these.
Eigen::VectorXd errorsBeyondDifferences(const SimulationData& held, const CurveModel& model);

/// The same of each window of a fit, predicted from the other records; where all windows are of one
/// record, from the other windows, with a gain and an offset of its own.
Eigen::VectorXd leftOutBeyondDifferences(const SimulationData& data, const WindowFit& fit);

/// Whether the unseen windows show what differs between experiments: those held out are of several,
/// or they are few and those fitted to are of several.
bool showDifferences(const SimulationData& data, const SimulationData& held);

/// Both of these: of windows left out and of windows held out. Empty where the latter is.
Eigen::VectorXd unseenBeyondDifferences(const SimulationData& data, const WindowFit& fit,
                                        const SimulationData& held);

}  // namespace uncertainty_identification
