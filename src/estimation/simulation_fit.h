#pragma once

#include <vector>

#include "model/linear_model.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Fit of the free simulation of the nominal model, 100 (1 - |y - ysim|/|y - mean y|) [%] over the
/// measured samples.
struct SimulationFit {
  std::vector<double> percent;  ///< of each experiment, with its own mean y
  double pooled = 0;            ///< of all experiments together, with the common mean y
  double pooled_own_means = 0;  ///< of all experiments together, each with its own mean y

  /// The pooled fit that says how much a model with these offsets explains: where each experiment
  /// has an offset of its own, what distinguishes their means is no merit of the plant.
  double pooledFor(Offsets offsets) const {
    return offsets == Offsets::per_experiment ? pooled_own_means : pooled;
  }
};

/// Coefficients of the responses Z (samples x unknowns) to initial state and offset, fitted to the
/// first measured samples of `error`: 20 and three more per unknown. Z and `error` are 0 where the
/// output was not measured. With more samples the free response of a slow pole could
/// follow a drift, and the simulation would look better than it is.
Eigen::VectorXd initialCoefficients(const Eigen::MatrixXd& Z, const Eigen::VectorXd& error);

/// The simulation error y - ysim of each experiment, 0 where y was not measured. ysim is Go u plus
/// the common offset. It starts from rest if initial_state is zero; otherwise from the initial
/// state (with Offsets::per_experiment also the offset) that fits the first samples best
/// (initialCoefficients()).
std::vector<Eigen::VectorXd> simulationErrors(const NominalModel& nominal,
                                              const Eigen::VectorXd& theta, double offset,
                                              const EstimationOptions& options,
                                              const std::vector<Experiment>& experiments);

/// The size of simulation errors relative to the variation of the outputs.
SimulationFit fitOfErrors(const std::vector<Eigen::VectorXd>& errors,
                          const std::vector<Experiment>& experiments);

/// The same, of the errors that simulationErrors() gives.
SimulationFit simulationFit(const NominalModel& nominal, const Eigen::VectorXd& theta,
                            double offset, const EstimationOptions& options,
                            const std::vector<Experiment>& experiments);

/// Whether the simulation errors `one` are larger than `other` by more than two standard errors of
/// the difference of their squares over parts of the data: the experiments or, where there are
/// fewer than ten, about ten parts of them. Errors of simulations of the same experiments.
bool areNoticeablyLarger(const std::vector<Eigen::VectorXd>& one,
                         const std::vector<Eigen::VectorXd>& other);

}  // namespace uncertainty_identification
