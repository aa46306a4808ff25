#pragma once

#include <memory>
#include <string>
#include <vector>

#include "uncertainty_identification/own_simulation/simulation.h"
#include "uncertainty_identification/own_simulation_options.h"

namespace uncertainty_identification {

/// The command that runs the FMU of these options, `path`, with these parameters: the program
/// simulate_fmu, which lies beside this one.
std::vector<std::string> fmuCommand(const OwnSimulationOptions& options, const std::string& path,
                                    const std::vector<SimulationParameter>& parameters);

/// The FMU in a process of its own. Parameters without a value have that of the FMU. Throws
/// FileError for an FMU that cannot be used, ConfigurationError for a name that it does not have.
std::unique_ptr<Simulation> startFmuSimulation(const OwnSimulationOptions& options);

}  // namespace uncertainty_identification
