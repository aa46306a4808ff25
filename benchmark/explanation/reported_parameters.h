#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "simulation/truth.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification::suite {

/// What a right explanation of a truth reports: values by "effect.parameter", or "effect
/// (variant).parameter" where they mean nothing to another variant, in the engine's names and units
/// (src/effects/). Parameters that are 0 in truth, or that the engine states otherwise
/// than by a value of the truth, are left out. `training` are the experiments that it explains,
/// about whose mean temperature it states plant_temp.
std::map<std::string, double> reportedParameters(const Truth& truth,
                                                 const std::vector<Experiment>& training);

/// The value that such a table has for a parameter, if any.
std::optional<double> valueOf(const std::map<std::string, double>& reported,
                              const std::string& effect, const std::string& variant,
                              const std::string& parameter);

}  // namespace uncertainty_identification::suite
