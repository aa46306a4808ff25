#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// An estimate from one experiment. All four are NaN where the experiment does not tell it.
struct ErrorNumber {
  double value = std::numeric_limits<double>::quiet_NaN();
  double standard_error = std::numeric_limits<double>::quiet_NaN();
  double lower = std::numeric_limits<double>::quiet_NaN();  ///< of the 95 % interval
  double upper = std::numeric_limits<double>::quiet_NaN();
};

/// How far the simulation of a user is from the machine in one experiment:
///
///     y(t) = bias + gain y_sim(t - delay) + e(t).
///
/// The standard errors hold for residuals e that are autocorrelated (regress()), as those
/// of a simulation are. Fit and bias alone are told of a simulation that stands still.
struct SimulationErrors {
  std::string id;     ///< of the experiment
  int samples = 0;    ///< measured output samples
  ErrorNumber fit;    ///< [%] 100 (1 - |y - y_sim| / |y - mean(y)|) of the simulation as it is
  ErrorNumber bias;   ///< [unit of y] what the machine's output is above gain y_sim
  ErrorNumber gain;   ///< [1] of the machine relative to the simulation; 1: they agree
  ErrorNumber delay;  ///< [s] by which the machine is later than the simulation
  std::vector<std::string> untold;  ///< for each number that is not told, a sentence saying why
};

/// The errors from the measured output y [N] and the simulated one [N], both [unit of y], on one
/// grid with this sample time [s]. `weight` [N]: 1 where y was measured, otherwise 0; y is not read
/// there. The delay is the nonlinear least-squares estimate, by Gauss and Newton's method with
/// cubic splines, near the best shift by whole samples of up to a tenth of the experiment, 500
/// samples at most.
SimulationErrors simulationErrors(const Eigen::VectorXd& y, const Eigen::ArrayXd& weight,
                                  const Eigen::VectorXd& y_sim, double sample_time);

/// Those of the simulated output that the experiment holds as the covariate `name`; nothing where
/// it has none.
std::optional<SimulationErrors> simulationErrors(const Experiment& experiment,
                                                 const std::string& name);

}  // namespace uncertainty_identification
