#pragma once

#include <Eigen/Core>
#include <limits>
#include <map>
#include <string>
#include <vector>

/// Options of a simulation that the user brings (docs/own_simulation.md).
namespace uncertainty_identification {

enum class TransferDomain { s, z };

/// A linear simulation: by the coefficients of a transfer function, by zeros, poles and gain, or by
/// physical parameters. One of the three is given.
struct OwnModelOptions {
  TransferDomain domain = TransferDomain::s;
  Eigen::VectorXd num, den;  ///< descending powers of s, or of z
  /// Numbers such as "-2" or "-3+4j"; complex ones stand with their conjugates. `gain` is then the
  /// factor before prod(s - zero) / prod(s - pole).
  std::vector<std::string> zeros, poles;
  /// gain, tau1.., omega1.., zeta1.., zero1.. and dead_time of nominal_model's continuous
  /// structure, in SI units. Of the other two forms only gain and dead_time are used.
  std::map<std::string, double> physical;
  double sample_time = 0;  ///< [s] domain z; 0: that of the data
};

/// Names that OwnModelOptions::physical may hold, in the order in which they are told.
const std::vector<std::string>& physicalNames();

/// A parameter of a program or an FMU, with the value that the user's simulation has.
struct OwnParameterOptions {
  /// Must be given for a program. NaN: that which the FMU states, with its unit.
  double value = std::numeric_limits<double>::quiet_NaN();
  std::string unit;
};

/// The user's simulation. Exactly one of model, result, command, fmu, column and topic is given.
struct OwnSimulationOptions {
  bool has_model = false;
  OwnModelOptions model;
  std::string result;                ///< file: the nominal model of an earlier result.json
  std::vector<std::string> command;  ///< program and its arguments
  std::string fmu;                   ///< file: a functional mock-up unit
  std::string input, output;         ///< variables of the FMU that u and y are
  int steps_per_sample = 10;         ///< of the integration, of an FMU for model exchange
  std::map<std::string, OwnParameterOptions> parameters;  ///< of the program or the FMU
  double time_limit = 10;      ///< [s] for one run of the program or the FMU over one experiment
  double memory_limit = 4000;  ///< [MB] of the program or the FMU
  std::string column;          ///< of data files: the logged output of the simulation
  std::string topic;           ///< the same as a topic of a bag
  std::string field = "auto";
  int max_simulations = 2000;  ///< runs over one experiment, in all: never exceeded

  /// Whether a logged signal is the simulation.
  bool isLogged() const { return !column.empty() || !topic.empty(); }

  /// Whether it runs in a process of its own, so that a run costs something.
  bool isProgram() const { return !command.empty() || !fmu.empty(); }

  /// Throws ConfigurationError naming key, value and what is allowed.
  void validate() const;
};

}  // namespace uncertainty_identification
