#pragma once

#include <memory>
#include <string>
#include <vector>

#include "uncertainty_identification/own_simulation/simulation.h"

namespace uncertainty_identification {

/// A program that answers lines of JSON (io/simulation_protocol.h).
struct ProgramToRun {
  std::vector<std::string> command;  ///< program and its arguments
  std::string description;           ///< as in Simulation
  std::vector<SimulationParameter> parameters;
  double time_limit = 10;      ///< [s] for one run
  double memory_limit = 4000;  ///< [MB]
};

/// Starts the program, which ends with the simulation. Throws ConfigurationError where it cannot be
/// started. Runs throw DataError where it fails, answers late or with something else.
std::unique_ptr<Simulation> startProgramSimulation(const ProgramToRun& program);

}  // namespace uncertainty_identification
