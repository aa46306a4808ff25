#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "own_simulation/compared_runs.h"

namespace uncertainty_identification {

/// What may be wrong with a simulation. All but `parameter` act on its output, since a simulation
/// that does not change with time answers a later input with a later output.
enum class ChangeKind {
  parameter,      ///< another value of a named parameter
  gain,           ///< the output is multiplied
  offset,         ///< a constant is added to the output
  delay,          ///< the output comes later, by any number of samples; earlier where negative
  lag,            ///< a further time constant: 1 / (1 + T s)
  time_constant,  ///< another time constant: (1 + T1 s) / (1 + T2 s)
  initial_state   ///< a transient at the beginning, c e^(-t/T), with a c for each experiment
};

/// A change with its coordinates, in which it is estimated:
/// parameter: log(value / yours), or value / step where yours is 0; gain: factor - 1; offset: [unit
/// of y]; delay and lag: [samples]; time_constant: log T1, log T2 [samples]; initial_state: T
/// [samples], which is not estimated but chosen.
struct Change {
  ChangeKind kind = ChangeKind::parameter;
  int parameter = -1;  ///< index, of kind parameter
  Eigen::VectorXd at;

  bool isSame(const Change& other) const {
    return kind == other.kind && parameter == other.parameter;
  }
  /// Number of estimated coordinates.
  Eigen::Index estimated() const { return kind == ChangeKind::initial_state ? 0 : at.size(); }
};

using Changes = std::vector<Change>;

/// Number of estimated coordinates of all.
Eigen::Index estimatedCoordinates(const Changes& changes);

/// The changes moved by a step of their estimated coordinates.
Changes moved(Changes changes, const Eigen::VectorXd& step);

/// Points from which a change is fitted; among them is, or near them, that of no change.
std::vector<Change> startsOf(ChangeKind kind, int parameter, int samples);

/// A simulation with changes.
class ChangedSimulation {
 public:
  /// Finds a step for the parameters whose value is 0, by running the first experiment.
  ChangedSimulation(SimulationRuns& runs, const ComparedData& data);

  SimulationRuns& runs() const { return runs_; }

  /// Value of a parameter at a coordinate of its change, and the derivative by it.
  double valueAt(int parameter, double coordinate) const;
  double slopeAt(int parameter, double coordinate) const;

  /// Whether a parameter keeps its sign, so that its logarithm is estimated.
  bool keepsSign(int parameter) const { return runs_.ownValues()[parameter] != 0; }

  /// The values of all parameters with the changes.
  Eigen::VectorXd values(const Changes& changes) const;

  /// The output of an experiment with the changes but for initial_state; not finite where it cannot
  /// be simulated.
  Eigen::VectorXd output(const ComparedRun& run, const Changes& changes) const;

  /// Its derivatives by the estimated coordinates, N x their number, by differences.
  Eigen::MatrixXd derivatives(const ComparedRun& run, const Changes& changes) const;

 private:
  SimulationRuns& runs_;
  Eigen::VectorXd step_;  ///< of the parameters that are 0
};

/// The transient of an initial_state change, N x 1, or N x 0 where there is none.
Eigen::MatrixXd transientOf(const Changes& changes, Eigen::Index samples);

}  // namespace uncertainty_identification
