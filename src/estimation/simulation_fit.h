#pragma once

#include <vector>

#include "model/linear_model.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Fit of the nominal model's free simulation, 100 (1 - |y - ysim|/|y - mean y|) [%] over the
/// measured samples.
struct SimulationFit {
  std::vector<double> percent;  ///< of each experiment, mean y its own
  double pooled = 0;            ///< of all together, with the mean over all of them
};

/// Coefficients of the responses Z (samples x unknowns) to initial state and offset that fit the
/// first samples of `error` best: 20 and three per unknown. More of them would let the free
/// response of a slow pole follow a drift, and the simulation look better than it is.
Eigen::VectorXd initialCoefficients(const Eigen::MatrixXd& Z, const Eigen::VectorXd& error);

/// What the free simulation leaves of each experiment's output, y - ysim, 0 where y was not
/// measured. ysim is Go u plus the common offset, from rest where initial_state is zero; else from
/// the initial state (and, under per_experiment, the experiment's own offset) that fits the first
/// samples best (initialCoefficients()).
std::vector<Eigen::VectorXd> simulationErrors(const NominalModel& nominal,
                                              const Eigen::VectorXd& theta, double offset,
                                              const EstimationOptions& options,
                                              const std::vector<Experiment>& experiments);

/// How large these errors are beside the outputs' own variation.
SimulationFit simulationFit(const NominalModel& nominal, const Eigen::VectorXd& theta,
                            double offset, const EstimationOptions& options,
                            const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
