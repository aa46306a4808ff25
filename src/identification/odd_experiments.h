#pragma once

#include <string>
#include <vector>

#include "estimation/parametrisation.h"
#include "model/linear_model.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Names the experiments whose output is another multiple of what the mean plant simulates than
/// that of all others, by far: another range or sign of the sensor, another unit, or another
/// machine. At most a tenth of the experiments, or one, of four or more. A sentence, or nothing.
///
/// @param offset of the output [unit of y]
std::string oddExperiments(const LinearModel& model, const ModelParameters& point, double offset,
                           EstimationOptions options, const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
