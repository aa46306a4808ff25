#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "uncertainty_identification/own_simulation/simulation.h"

/// A machine whose own simulation is known, with a wrong parameter or another flaw on purpose.
namespace uncertainty_identification {

/// A pendulum driven by a torque, with friction, 0.02 s a sample: not linear at its amplitudes of
/// about one radian. Parameters: mass [kg], friction [N m s], length [m].
class PendulumSimulation : public Simulation {
 public:
  std::string description() const override { return "the pendulum"; }
  std::vector<SimulationParameter> parameters() const override {
    return {{"mass", 1.0, "kg"}, {"friction", 0.4, "N m s"}, {"length", 0.5, "m"}};
  }
  bool canRerun() const override { return true; }
  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override;
};

/// How experiments are made.
struct MachineOptions {
  int experiments = 20, samples = 300;
  double sample_time = 0.02;
  double amplitude = 1.5;  ///< standard deviation of the input, held for 15 samples
  double noise = 0.0316;   ///< standard deviation relative to the output's: 30 dB
  double spread = 0;       ///< of the output's gain from run to run, relative
  std::uint64_t seed = 1;
  std::function<Eigen::VectorXd(const Eigen::VectorXd& u)> input_curve;  ///< before the machine
  std::function<Eigen::VectorXd(const Eigen::VectorXd& y, int run)> output_change;  ///< behind it
};

/// Experiments of a machine that behaves as `simulation` with these values of its parameters.
std::vector<Experiment> recordMachine(Simulation& simulation, const Eigen::VectorXd& values,
                                      const MachineOptions& options);

/// The same with the simulation's own values but for the k-th, which is multiplied.
std::vector<Experiment> recordWithFactor(Simulation& simulation, int k, double factor,
                                         const MachineOptions& options);

}  // namespace uncertainty_identification
