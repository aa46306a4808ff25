#pragma once

#include <vector>

#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// Whether Go has an oscillation that no experiment sees decay to 5 % and that is not an answer to
/// the input: over the experiments, its free response, fitted to what the forced response of Go and
/// `offset` [unit of y] leave, has more power than its forced response. Such an oscillation follows
/// a disturbance.
bool hasUnexcitedOscillation(const Polynomials& plant, double offset,
                             const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
