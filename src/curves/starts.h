#pragma once

#include <string>

#include "curves/curve_model.h"
#include "curves/simulation_data.h"

namespace uncertainty_identification {

/// A linear model by ARX and the iteration of Steiglitz and McBride: of its iterates, that with the
/// least error of the free simulation. Poles outside 0.998 are pulled to 0.99.
CurveModel linearStart(const SimulationData& data, int order, bool direct, int delay,
                       int iterations = 8);

/// How many times as much as the input the covariate moves the output at rest, -30 to 30: a plant
/// of the order and delay of `linear` with a numerator for each of the two, found in the same way.
double ratioOfGains(const SimulationData& data, const CurveModel& linear,
                    const std::string& covariate);

/// The linear model, which has no direct term, with two orders more: a second plant beside it,
/// which is the start for what it leaves of the output. Modes of a structure add up like this.
CurveModel withMode(const SimulationData& data, const CurveModel& model);

/// The model with one order more: a pole at `pole` that a zero cancels.
CurveModel withCancellingPair(const CurveModel& model, double pole);

}  // namespace uncertainty_identification
