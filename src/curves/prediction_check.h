#pragma once

#include <optional>

#include "curves/curve_model.h"
#include "curves/simulation_data.h"

namespace uncertainty_identification {

/// What a simulation adds to the prediction of outputs.
struct PredictionGain {
  double share = 0;  ///< of the squared error
  double t = 0;      ///< Student's t, paired over the held-out windows
};

/// What the simulation of `after` adds to predicting the next output of held-out windows from past
/// outputs, the input and the simulation of `before`. The simulations begin from the first samples
/// of each window and know no later output. So where the plant is linear they add nothing, be the
/// input a controller's answer to disturbances or not. Least squares on the windows of `data`.
/// Absent where too few outputs are measured in succession.
std::optional<PredictionGain> predictionGain(const SimulationData& data, const SimulationData& held,
                                             const CurveModel& before, const CurveModel& after);

/// The largest real pole of a linear plant that predicts the next output of the windows from past
/// outputs and the input, by least squares: the factor from sample to sample by which a response
/// grows. Far above 1 where a controller holds an unstable plant, whose free simulation says
/// little; 0 where no pole is positive or too few outputs are measured in succession.
double predictedGrowth(const SimulationData& data);

}  // namespace uncertainty_identification
