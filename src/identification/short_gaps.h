#pragma once

#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// The experiments with their short gaps filled: outputs that are missing for at most three samples
/// in a row, in records that lack at most 5 % of them, are what the plant simulates plus its error,
/// interpolated between the neighbours. Good enough to compare structures, and records without gaps
/// are evaluated many times faster. `offset` [unit of y]: of the plant.
std::vector<Experiment> withShortGapsFilled(std::vector<Experiment> experiments,
                                            const Polynomials& plant, double offset,
                                            const EstimationOptions& options);

}  // namespace uncertainty_identification
