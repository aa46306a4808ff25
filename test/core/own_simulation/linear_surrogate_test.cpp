#include "own_simulation/linear_surrogate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "own_simulation/linear_simulation.h"
#include "support/own_machine.h"

namespace uncertainty_identification {
namespace {

std::vector<Experiment> answers(Simulation& simulation, double amplitude) {
  MachineOptions options;
  options.amplitude = amplitude;
  options.noise = 0;
  options.experiments = 6;
  return recordWithFactor(simulation, -1, 1, options);
}

double valueNamed(const Simulation& simulation, const std::string& name) {
  for (const SimulationParameter& parameter : simulation.parameters())
    if (parameter.name == name) return parameter.value;
  ADD_FAILURE() << name << " is no parameter";
  return 0;
}

TEST(LinearSurrogate, FindsTheParametersOfALinearSimulation) {
  OwnModelOptions options;
  options.physical = {{"gain", 2.0}, {"omega1", 8.0}, {"zeta1", 0.4}};
  const auto own = makeLinearSimulation(factorsOf(options, MachineOptions().sample_time), "own");
  const LinearFit fit = fitLinear(answers(*own, 1), "the linear model");
  ASSERT_NE(fit.simulation, nullptr);
  EXPECT_GT(fit.fit, 99.9);
  EXPECT_NEAR(valueNamed(*fit.simulation, "gain"), 2, 0.01);
  EXPECT_NEAR(valueNamed(*fit.simulation, "omega1"), 8, 0.05);
  EXPECT_NEAR(valueNamed(*fit.simulation, "zeta1"), 0.4, 0.01);
  EXPECT_EQ(fit.simulation->description(), "the linear model");
}

/// Small angles: gain 1 / (m g l), frequency sqrt(g / l).
TEST(LinearSurrogate, IsTheLinearMotionOfANonlinearSimulation) {
  PendulumSimulation pendulum;
  const LinearSurrogate surrogate = fitSurrogate(pendulum, answers(pendulum, 0.1));
  ASSERT_NE(surrogate.simulation, nullptr);
  EXPECT_GT(surrogate.fit, 98);
  EXPECT_NEAR(valueNamed(*surrogate.simulation, "gain"), 1 / (9.81 * 0.5), 0.01);
  EXPECT_NEAR(valueNamed(*surrogate.simulation, "omega1"), std::sqrt(9.81 / 0.5), 0.1);
}

TEST(LinearSurrogate, KeepsTheSimulationsOwnOutputAndAddsWhatParametersChange) {
  PendulumSimulation pendulum;
  const std::vector<Experiment> recorded = answers(pendulum, 1.0);
  const LinearSurrogate surrogate = fitSurrogate(pendulum, recorded);
  ASSERT_NE(surrogate.simulation, nullptr);
  const SimulationInput input = inputOf(recorded[0]);
  Eigen::VectorXd values = ownValuesOf(*surrogate.simulation);
  const Eigen::VectorXd own = pendulum.run(input, ownValuesOf(pendulum));
  EXPECT_EQ(surrogate.simulation->run(input, values), own);
  const LinearFit linear = fitLinear(recorded, "");
  const Eigen::VectorXd before = linear.simulation->run(input, values);
  values[0] *= 1.2;
  const Eigen::VectorXd change = linear.simulation->run(input, values) - before;
  EXPECT_GT(change.norm(), 0.1 * own.norm());
  EXPECT_LT((surrogate.simulation->run(input, values) - own - change).norm(), 1e-9 * own.norm());
}

/// y = u^2 has no linear part that says anything about it.
class Squarer : public Simulation {
 public:
  std::string description() const override { return "the squarer"; }
  std::vector<SimulationParameter> parameters() const override { return {}; }
  bool canRerun() const override { return true; }
  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd&) override {
    return input.u.array().square();
  }
};

TEST(LinearSurrogate, IsNoneWhereALinearModelSaysNothing) {
  Squarer squarer;
  const LinearSurrogate surrogate = fitSurrogate(squarer, answers(squarer, 1));
  EXPECT_EQ(surrogate.simulation, nullptr);
  EXPECT_LT(surrogate.fit, kLeastSurrogateFit);
}

}  // namespace
}  // namespace uncertainty_identification
