#pragma once

#include <vector>

#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/model/linear_model.h"

namespace uncertainty_identification {

/// Fit of the nominal model's free simulation, 100 (1 - |y - ysim|/|y - mean y|) [%] over the measured samples.
struct SimulationFit {
  std::vector<double> percent;  ///< of each experiment, mean y its own
  double pooled = 0;            ///< of all together, with the mean over all of them
};

/// Go u plus the common offset, from rest where initial_state is zero; else the free response of Go (and the
/// experiment's own offset under per_experiment) that fits each experiment best is added, because an initial state is no
/// property of the model.
SimulationFit simulationFit(const NominalModel& nominal, const Eigen::VectorXd& theta, double offset,
                            const EstimationOptions& options, const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
