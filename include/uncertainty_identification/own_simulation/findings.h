#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "uncertainty_identification/curves/simulation_causes.h"
#include "uncertainty_identification/own_simulation/extension.h"

/// What the user's own simulation gets wrong.
namespace uncertainty_identification {

/// A number that the simulation has wrong. A standard error that could not be computed is NaN.
struct OwnValue {
  std::string name, unit;
  double yours = 0, measured = 0;
  double standard_error = 0;          ///< of `measured`; experiments are independent
  double lower_95 = 0, upper_95 = 0;  ///< of `measured`, by Student's t
  double run_spread = 0;  ///< standard deviation from experiment to experiment; 0: none is seen
};

/// A cause of the simulation's error.
struct OwnCause {
  std::string name;  ///< "sim_parameter", "sim_gain", "sim_delay", ... (docs/own_simulation.md)
  std::string parameter;    ///< name, of sim_parameter
  std::string description;  ///< with its values: "gain 9.1 +- 0.4 % higher"
  std::string remark;       ///< what the value looks like, such as another unit; may be empty
  std::string advice;       ///< what to change or to check
  std::vector<OwnValue> values;
  double t = 0;                   ///< size by standard error; NaN where it has several values
  double fit_without = 0;         ///< [%] of held-out runs, with all other causes
  std::vector<std::string> ties;  ///< in words: explain the data as well
};

/// A held-out run, measured and simulated.
struct OwnRun {
  std::string rank;  ///< "best", "median" or "worst", by the error of the user's simulation
  std::string id;
  double sample_time = 0, start = 0;          ///< [s]
  Eigen::VectorXd measured, yours, extended;  ///< extended: with the causes
  double fit_yours = 0, fit_extended = 0;     ///< [%]
};

/// The result of comparing the user's simulation with the data.
struct OwnSimulationFindings {
  std::string simulation;  ///< Simulation::description()
  bool can_rerun = false;
  /// [%] of its output by a linear model, where it has no parameters of its own: gain and time
  /// constants are then those of this model, if it fits at least 90 %.
  double surrogate_fit = 0;
  std::string sentence;                  ///< the answer in one sentence
  std::vector<OwnCause> causes;          ///< what gains most on held-out runs first
  double fit_before = 0, fit_after = 0;  ///< [%] of held-out runs: yours, and with the causes
  std::vector<std::string> held_out;     ///< ids; empty: the last third of each run was held out
  std::vector<OwnRun> runs;
  /// Curves that it lacks besides, at places before, in and behind it.
  SimulationCauses structure;
  /// Whether the first of them stands before or behind the simulation in all that is told: in the
  /// causes, fit_after and runs. Otherwise these are of the simulation without curves.
  bool has_curve_around = false;
  OwnExtension extension;    ///< with what fit_after is reached
  int simulations = 0;       ///< runs over one experiment
  bool ended_early = false;  ///< simulation.max_simulations, or cancelled

  /// Whether the curves halve the squared error, also that which the causes leave, so that causes
  /// found without them may only stand for the curves.
  bool curveLeads() const;
};

}  // namespace uncertainty_identification
