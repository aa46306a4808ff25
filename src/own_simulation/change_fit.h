#pragma once

#include <Eigen/Core>
#include <vector>

#include "own_simulation/change.h"

namespace uncertainty_identification {

/// Changes fitted to the free simulation of all runs by least squares.
struct ChangeFit {
  Changes changes;
  double squared_error = 0;
  Eigen::VectorXd left_out_of;  ///< squared error of each unit, predicted from the other units
  Eigen::MatrixXd covariance;   ///< of the coordinates, robust: units are independent (sandwich)

  double leftOut() const { return left_out_of.sum(); }
};

/// Squared error of the simulation with the changes for each unit of the data; transients of
/// initial_state are fitted to each run. Not finite where it cannot be simulated.
Eigen::VectorXd errorsOf(const ChangedSimulation& simulation, const ComparedData& data,
                         const Changes& changes);

/// One linearised step from the changes, without further runs at its end.
ChangeFit stepOnce(const ChangedSimulation& simulation, const ComparedData& data,
                   const Changes& changes);

/// Gauss and Newton with Marquardt's damping. Ends with what it has where no further run is
/// allowed; without any, leftOut() is infinite.
ChangeFit fitChanges(const ChangedSimulation& simulation, const ComparedData& data,
                     Changes changes);

/// How a coordinate differs from experiment to experiment.
struct RunSpread {
  double deviation = 0;      ///< standard deviation, without what the noise of the estimates adds
  bool significant = false;  ///< beyond what the noise explains, with 99.9 %
};

/// For each coordinate; nothing where there are fewer than five experiments.
std::vector<RunSpread> spreadOf(const ChangedSimulation& simulation, const ComparedData& data,
                                const Changes& changes);

}  // namespace uncertainty_identification
