#pragma once

#include <memory>
#include <string>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/own_simulation/simulation.h"

namespace uncertainty_identification {

/// Name of the signal of the experiments that a logged simulation is.
std::string loggedName(const OwnSimulationOptions& options);

/// The configuration with which data are read: a logged simulation is a signal among the
/// covariates. Unchanged without one.
Configuration withLoggedSimulation(Configuration configuration);

/// The simulation of configuration.simulation, for data with this sample time [s]. A program is
/// started: call it for a user at the command line only, never for a configuration that came over
/// a network. Throws ConfigurationError, or FileError for a result that cannot be read.
std::unique_ptr<Simulation> openSimulation(const OwnSimulationOptions& options, double sample_time);

/// Throws ConfigurationError where the configuration gives a simulation that does not arrive at a
/// node beside the measurement: as a topic, or, where whole experiments arrive as messages, as
/// `column`, the name of a covariate in them.
void requirePublishedSimulation(const Configuration& configuration);

/// Throws ConfigurationError where the configuration gives a simulation: `who` does not compare
/// one.
void refuseSimulation(const Configuration& configuration, const std::string& who);

}  // namespace uncertainty_identification
