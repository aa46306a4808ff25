#pragma once

#include <map>
#include <memory>
#include <string>

#include "uncertainty_identification/own_simulation/simulation.h"

namespace uncertainty_identification {

/// Which variables of an FMU are compared.
struct FmuSignals {
  std::string input, output;
  std::map<std::string, double> parameters;  ///< with the values of the user's simulation
  int steps_per_sample = 10;                 ///< of model exchange
};

/// Loads an FMU into this process, in which it then runs; one that crashes takes the process along.
/// Its output is that at each sample, before the input of this sample acts. Throws FileError as
/// UnpackedFmu does, ConfigurationError for a name that the FMU does not have.
std::unique_ptr<Simulation> loadFmu(const std::string& path, const FmuSignals& signals);

}  // namespace uncertainty_identification
