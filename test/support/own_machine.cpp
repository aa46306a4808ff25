#include "support/own_machine.h"

#include <cmath>
#include <random>

namespace uncertainty_identification {

Eigen::VectorXd PendulumSimulation::run(const SimulationInput& input,
                                        const Eigen::VectorXd& values) {
  constexpr int kSteps = 4;
  constexpr double kGravity = 9.81;
  const double mass = values[0], friction = values[1], length = values[2];
  const double step = input.sample_time / kSteps, inertia = mass * length * length;
  double angle = 0, speed = 0;
  Eigen::VectorXd y(input.u.size());
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    y[k] = angle;
    for (int i = 0; i < kSteps; ++i) {
      speed += step * (input.u[k] - friction * speed - mass * kGravity * length * std::sin(angle)) /
               inertia;
      angle += step * speed;
    }
  }
  return y;
}

std::vector<Experiment> recordMachine(Simulation& simulation, const Eigen::VectorXd& values,
                                      const MachineOptions& options) {
  constexpr int kHold = 15;
  std::mt19937_64 random(options.seed);
  std::normal_distribution<double> normal;
  std::vector<Experiment> all;
  for (int r = 0; r < options.experiments; ++r) {
    Experiment experiment;
    experiment.id = "run" + std::to_string(r);
    experiment.sample_time = options.sample_time;
    experiment.u.resize(options.samples);
    for (int k = 0; k < options.samples; ++k)
      experiment.u[k] = k % kHold == 0 ? options.amplitude * normal(random) : experiment.u[k - 1];
    SimulationInput input = inputOf(experiment);
    if (options.input_curve) input.u = options.input_curve(input.u);
    Eigen::VectorXd y = (1 + options.spread * normal(random)) * simulation.run(input, values);
    if (options.output_change) y = options.output_change(y, r);
    const double size = std::sqrt((y.array() - y.mean()).square().mean());
    for (Eigen::Index k = 0; k < y.size(); ++k) y[k] += options.noise * size * normal(random);
    experiment.y = y;
    all.push_back(experiment);
  }
  return all;
}

std::vector<Experiment> recordWithFactor(Simulation& simulation, int k, double factor,
                                         const MachineOptions& options) {
  const std::vector<SimulationParameter> parameters = simulation.parameters();
  Eigen::VectorXd values(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i)
    values[static_cast<Eigen::Index>(i)] = parameters[i].value;
  if (k >= 0) values[k] *= factor;
  return recordMachine(simulation, values, options);
}

}  // namespace uncertainty_identification
