#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/own_simulation/findings.h"

namespace uncertainty_identification {

/// Throws FileError when writeExtendedSimulation() cannot write into this folder, would replace one
/// of the `inputs` or a file that the simulation is run with, or writes what is also `output`;
/// ConfigurationError where there is no simulation.
void requireExtendedWritable(const std::string& folder, const Configuration& configuration,
                             std::vector<std::string> inputs, const std::string& output);

/// extended_simulation.json (docs/own_simulation.md): how the simulation is run, its parameters as
/// given and as measured, and what stands around it. `folder`: where a program is started.
nlohmann::json extendedSimulationJson(const OwnSimulationOptions& options,
                                      const OwnSimulationFindings& findings,
                                      const std::string& folder);

/// The same as a module and program of Python's standard library.
std::string extendedSimulationPython(const nlohmann::json& extended);

/// The same in C++17, without dependencies.
std::string extendedSimulationCpp(const nlohmann::json& extended);

/// Writes all of them, and `compared`, the experiments that findings.fit_after was measured on, as
/// held_out.csv. Creates the folder. Throws FileError.
void writeExtendedSimulation(const std::string& folder, const OwnSimulationOptions& options,
                             const OwnSimulationFindings& findings,
                             const std::vector<Experiment>& compared);

}  // namespace uncertainty_identification
