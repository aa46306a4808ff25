#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// A parameter of a simulation, with the value that its author gave it.
struct SimulationParameter {
  std::string name;
  double value = 0;
  std::string unit;  ///< empty where it is not known
};

/// What one run of a simulation reads.
struct SimulationInput {
  double sample_time = 0;                          ///< [s]
  Eigen::VectorXd u;                               ///< N, held from sample to sample
  std::map<std::string, Eigen::VectorXd> signals;  ///< covariates measured at each sample, N each
  std::map<std::string, double> scalars;           ///< covariates constant over the experiment
};

/// The input of an experiment, as it was measured.
SimulationInput inputOf(const Experiment& experiment);

/// A simulation that the user brings: it computes the output of the machine from its input.
class Simulation {
 public:
  virtual ~Simulation() = default;

  /// In a few words, such as "the program ./my_sim".
  virtual std::string description() const = 0;

  /// May be empty.
  virtual std::vector<SimulationParameter> parameters() const = 0;

  /// Whether it can be run with another input or other parameters. A logged signal cannot.
  virtual bool canRerun() const = 0;

  /// The output [N] for an input and values of parameters(), from the simulation's own start. A
  /// value that is not finite means that these parameters cannot be simulated. Throws DataError,
  /// with the reason, where the simulation fails.
  virtual Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) = 0;
};

}  // namespace uncertainty_identification
