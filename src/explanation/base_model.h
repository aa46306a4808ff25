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

/// The offsets of the base model, `estimate` or those stated. Where the orders are left to be
/// chosen, so is whether each experiment has an offset of its own, if their levels differ: a common
/// offset would make slow dynamics of the levels. The base model's estimate tells what was chosen.
Offsets offsetsOfBaseModel(const Configuration& asked, const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
