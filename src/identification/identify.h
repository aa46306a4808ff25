#pragma once

#include <vector>

#include "identification/problem.h"
#include "uncertainty_identification/bounds/prediction_calibration.h"

namespace uncertainty_identification {

/// Identifies the model that a request asks for. Errors as of Identifier::identify().
Estimate identify(const Request& request, const std::vector<Experiment>& experiments,
                  const std::vector<Experiment>& validation);

/// Identifies the nominal plant alone, without the errors of its parameters: what a fold of a
/// calibration needs.
FoldModel identifyPlant(const Request& request, const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
