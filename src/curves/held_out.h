#pragma once

#include <Eigen/Core>
#include <vector>

#include "curves/curve_model.h"
#include "curves/simulation_data.h"
#include "curves/window_fit.h"

namespace uncertainty_identification {

/// Squared error of simulating each held-out window, or parts of windows where they are few,
/// [standard deviations of y]^2. The initial state is taken from the first tenth of a window's
/// samples, at least 20; together with a level of its own, from all.
Eigen::VectorXd heldOutErrors(const SimulationData& held, const CurveModel& model);

/// Squared error of simulating the windows, each from the initial values that fit all of its
/// samples best.
double errorFromBestStates(const SimulationData& held, const CurveModel& model);

/// Squared errors of all windows that a fit has not seen: of those that it leaves out in turn, and
/// of the held-out ones. What tells one place from another needs all the evidence there is.
Eigen::VectorXd unseenErrors(const WindowFit& fit, const SimulationData& held);

/// Number of first samples of each window that the initial state of its simulation is taken from.
int seenSamples(const SimulationData& held, const CurveModel& model);

/// Simulated outputs of the held-out windows, in the same way.
std::vector<Eigen::VectorXd> heldOutSimulations(const SimulationData& held,
                                                const CurveModel& model);

/// Fit [%]: 100 (1 - |error| / |y - mean|), over all windows.
double heldOutFit(const SimulationData& held, const Eigen::VectorXd& errors);

}  // namespace uncertainty_identification
