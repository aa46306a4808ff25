#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Throws ConfigurationError where the configuration of the base model is not valid, its error
/// model one that effects cannot be added to, or an excluded effect not in the catalogue.
void requireExplainable(const Configuration& configuration,
                        const std::vector<Experiment>& experiments);

/// The configuration of the base model. Effects can be added to filters in series with Go only, and
/// where the orders are free the search starts from the best simulation.
Configuration ofBaseModel(Configuration configuration);

}  // namespace uncertainty_identification
