#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
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
  /// N, the input that was measured, where a curve has made u of it; otherwise empty. A signal that
  /// was logged belongs to the measured one.
  Eigen::VectorXd measured_u;
};

/// The input of an experiment, as it was measured.
SimulationInput inputOf(const Experiment& experiment);

/// A linear filter from rest: y(k) = sum_j num[j] u(k - j) - sum_(j > 0) den[j] y(k - j), den[0]
/// = 1.
struct SampledFilter {
  Eigen::VectorXd num, den;
};

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

  /// The simulation with these values as a filter for this sample time [s]. Nothing where it is not
  /// known to be linear, or where the values cannot be simulated.
  virtual std::optional<SampledFilter> filterAt(const Eigen::VectorXd& /*values*/,
                                                double /*sample_time*/) const {
    return std::nullopt;
  }
};

}  // namespace uncertainty_identification
