#pragma once

#include <memory>
#include <string>
#include <vector>

#include "uncertainty_identification/own_simulation/simulation.h"

namespace uncertainty_identification {

/// The output of a simulation that was logged beside the measurement, as the signal `name` of each
/// experiment. It has no parameters and cannot be run again. `description` as in Simulation.
std::unique_ptr<Simulation> makeLoggedSimulation(const std::string& name,
                                                 const std::string& description);

/// The experiments without that signal, so that it is no covariate of the machine.
std::vector<Experiment> withoutSignal(std::vector<Experiment> experiments, const std::string& name);

}  // namespace uncertainty_identification
