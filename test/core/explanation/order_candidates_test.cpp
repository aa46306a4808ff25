// The models on top of which causes are looked for when the orders were chosen from the data.
#include "explanation/order_candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

/// Twelve experiments of Example 1, whose plant is of order 1, shortened to so many samples.
std::vector<Experiment> example1(int samples) {
  std::vector<Experiment> experiments = test::example1(2, 12).experiments;
  for (Experiment& experiment : experiments) {
    experiment.u.conservativeResize(samples);
    experiment.y.conservativeResize(samples);
  }
  return experiments;
}

/// The orders of the candidates if `order` was chosen for the plant.
std::vector<NominalModelOptions> candidates(const std::vector<Experiment>& experiments, int order) {
  Configuration configuration = test::example1Configuration();
  configuration.nominal_model.na = configuration.nominal_model.nb = order;
  if (experiments.size() == 1) configuration.error_model.taps = 0;
  const Estimate estimate = Identifier(configuration).identify(experiments);
  configuration.nominal_model.orders_auto = true;
  WorkerPool pool(1);
  FitContext context;
  context.pool = &pool;
  context.going_on = [] { return true; };
  std::vector<NominalModelOptions> orders;
  for (const Estimate& each : orderCandidates(configuration, estimate, experiments, context, {}))
    orders.push_back(each.configuration.nominal_model);
  return orders;
}

TEST(OrderCandidates, LeavesThoseThatSuffice) {
  const auto orders = candidates(example1(100), 1);
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_EQ(orders[0].na, 1);
}

/// Two more poles would need 22 samples, and there are 20: the orders stay, and nothing fails.
TEST(OrderCandidates, TriesNoMoreThanTheDataAllow) {
  EXPECT_EQ(candidates({example1(20).front()}, 2).front().na, 2);
}

/// The recorded input passes through a lag before it becomes Example 1's input, so the plant is of
/// order 2, and order 1 was chosen. Models of both orders are given, the larger first, with the
/// same orders of the noise model.
TEST(OrderCandidates, RaisesThoseThatAreTooLowAndKeepsThemAsTheSmallerModel) {
  constexpr double kPole = 0.7;
  std::vector<Experiment> experiments = example1(100);
  for (Experiment& experiment : experiments) {
    const Eigen::VectorXd acting = experiment.u;
    experiment.u.tail(99) -= kPole * acting.head(99);
    experiment.u /= 1 - kPole;
  }
  const auto orders = candidates(experiments, 1);
  ASSERT_EQ(orders.size(), 2U);
  EXPECT_EQ(orders[0].na, 2);
  EXPECT_EQ(orders[1].na, 1);
  EXPECT_EQ(orders[1].nb, 1);
  EXPECT_EQ(orders[1].nc, orders[0].nc);
  EXPECT_EQ(orders[1].nd, orders[0].nd);
}

/// A mass on a spring that Coulomb friction holds as long as the force is small: its position, read
/// with little noise.
std::vector<Experiment> massWithFriction() {
  constexpr double kStep = 0.01, kFriction = 0.5;
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  std::vector<Experiment> all(6);
  for (Experiment& experiment : all) {
    experiment.sample_time = 10 * kStep;
    experiment.id = "run " + std::to_string(&experiment - all.data());
    experiment.u = experiment.y = Eigen::VectorXd::Zero(300);
    double position = 0, speed = 0, force = 0;
    for (int k = 0; k < 300; ++k) {
      if (k % 10 == 0) force = std::clamp(0.6 * normal(engine), -1.0, 1.0);
      experiment.u[k] = force;
      experiment.y[k] = position + 1e-3 * normal(engine);
      for (int i = 0; i < 10; ++i) {
        const double drive = force - 0.2 * position - 0.3 * speed;
        const bool sticks = speed == 0 && std::abs(drive) < kFriction;
        const double sign = speed != 0 ? speed : drive;
        const double next = speed + kStep * (drive - std::copysign(kFriction, sign));
        speed = sticks || next * speed < 0 ? 0 : next;
        position += kStep * speed;
      }
    }
  }
  return all;
}

/// The likelihood predicts a mass that sticks from where it is, whatever the force: its Go
/// simulates far worse than the one that was fitted to the simulation.
TEST(OrderCandidates, HoldsThePlantWhereTheLikelihoodLeavesItsSimulation) {
  const std::vector<Experiment> experiments = massWithFriction();
  Configuration configuration;
  configuration.nominal_model.fit = PlantFit::simulation;
  configuration.error_model.basis = BasisKind::fir;
  configuration.estimation.initial_state = InitialState::estimate;
  configuration.estimation.offsets = Offsets::estimate;
  const Estimate estimate = Identifier(configuration).identify(experiments);
  WorkerPool pool(1);
  FitContext context;
  context.pool = &pool;
  context.going_on = [] { return true; };
  const auto all = orderCandidates(configuration, estimate, experiments, context, {});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].configuration.nominal_model.fit, PlantFit::simulation);
  EXPECT_EQ(all[0].nominal_model.a, estimate.nominal_model.a);
}

}  // namespace
}  // namespace uncertainty_identification
