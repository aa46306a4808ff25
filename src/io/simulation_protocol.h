#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/own_simulation/simulation.h"

/// The lines that a simulation in a program of its own reads and writes (docs/own_simulation.md).
namespace uncertainty_identification {

/// One run of a simulation.
struct SimulationRequest {
  SimulationInput input;
  Eigen::VectorXd values;  ///< of the parameters
};

/// The line for a run, with its newline.
std::string requestText(const SimulationInput& input,
                        const std::vector<SimulationParameter>& parameters,
                        const Eigen::VectorXd& values);

/// Reads such a line; parameters that it leaves out have their own values. Throws DataError.
SimulationRequest requestFrom(const std::string& line,
                              const std::vector<SimulationParameter>& parameters);

/// The line that answers, with its newline; values that are not finite are null.
std::string answerText(const Eigen::VectorXd& y);

/// The output that an answer holds. Throws DataError that says what was found instead.
Eigen::VectorXd answerFrom(const std::string& line);

}  // namespace uncertainty_identification
