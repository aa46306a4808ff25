#pragma once

#include <vector>

#include "identification/problem.h"
#include "uncertainty_identification/bounds/prediction_calibration.h"

namespace uncertainty_identification {

/// Identifies the model that a request asks for. Errors as of Identifier::identify().
Estimate identify(const Request& request, const std::vector<Experiment>& experiments,
                  const std::vector<Experiment>& validation);

/// Identifies the nominal plant without standard errors and error distribution, as the folds of a
/// calibration need it.
FoldModel identifyPlant(const Request& request, const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
