#pragma once

#include <Eigen/Core>
#include <vector>

#include "curves/curve_model.h"
#include "curves/simulation_data.h"

namespace uncertainty_identification {

/// Initial values of all windows, each by Levenberg and Marquardt on its first `samples`.
std::vector<Eigen::VectorXd> initialStates(const SimulationData& data, const CurveModel& model,
                                           int samples, int iterations = 6);

}  // namespace uncertainty_identification
