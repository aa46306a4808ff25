#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "simulation/truth.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification::suite {

/// The true values of the parameters that explain() reports for the effects of a truth, in its
/// units (src/effects/). Their names are "effect.parameter", or "effect (variant).parameter" where
/// they do not hold for the other variants. Parameters whose true value is 0 are left out.
/// Parameters of the truth that explain() does not report are in the table too, under their own
/// keys. `training` are the experiments that are explained: explain() states plant_temp relative to
/// their mean temperature.
std::map<std::string, double> reportedParameters(const Truth& truth,
                                                 const std::vector<Experiment>& training);

/// Looks up the value of a parameter in the table of reportedParameters().
std::optional<double> valueOf(const std::map<std::string, double>& reported,
                              const std::string& effect, const std::string& variant,
                              const std::string& parameter);

}  // namespace uncertainty_identification::suite
