// Identifies a user's own nominal model (motor_model.h) and the uncertainty of a fleet of such
// motors, whose inertias differ because they drive different loads. docs/adding_a_nominal_model.md
// explains this program. Exit status: 0 if the estimated parameters agree with the simulated ones.

#include "motor_model.h"

#include <cmath>
#include <iostream>
#include <memory>
#include <random>
#include <vector>

#include "uncertainty_identification/identifier.h"

namespace ui = uncertainty_identification;

namespace {

constexpr double kSampleTime = 0.02;  // [s]
constexpr double kInertia = 1e-4;     // [kg m^2] of the typical motor
constexpr double kFriction = 1e-4;    // [N m s/rad]
constexpr double kSpread = 0.03;      // standard deviation of the logarithm of the inertia
constexpr double kNoise = 0.5;        // [rad/s] standard deviation of the speed sensor

/// A motor at rest is driven by random steps of voltage.
ui::Experiment experiment(int number, std::mt19937_64* engine) {
  constexpr int kSamples = 400, kHold = 5;
  std::normal_distribution<double> normal;
  const double inertia = kInertia * std::exp(kSpread * normal(*engine));
  const ui::Polynomials motor =
      MotorModel(kSampleTime).polynomials(Eigen::Vector2d(inertia, kFriction));
  ui::Experiment recorded;
  recorded.id = "motor_" + std::to_string(number);
  recorded.sample_time = kSampleTime;
  recorded.u.resize(kSamples);
  recorded.y.resize(kSamples);
  double speed = 0;
  for (int t = 0; t < kSamples; ++t) {
    recorded.u[t] = t % kHold == 0 ? 5 * normal(*engine) : recorded.u[t - 1];
    recorded.y[t] = speed + kNoise * normal(*engine);
    speed = motor.b[0] * recorded.u[t] - motor.a[0] * speed;
  }
  return recorded;
}

ui::Configuration configuration() {
  ui::Configuration configuration;
  // the nominal motor is the mean of the fleet, so that its inertia is a typical one
  configuration.error_model.constraint = ui::Constraint::zero_mean;
  configuration.error_model.basis = ui::BasisKind::laguerre;
  configuration.error_model.pole = 0.35;
  configuration.error_model.taps = 4;
  configuration.error_model.components = 1;
  configuration.estimation.initial_state = ui::InitialState::zero;
  configuration.estimation.offsets = ui::Offsets::none;
  return configuration;
}

bool print(const ui::ParameterEstimate& found, double truth, double tolerance) {
  std::cout << found.name << ": " << found.value << " +- " << found.standard_error << " "
            << found.unit << " (simulated: " << truth << ")\n";
  return std::abs(found.value / truth - 1) < tolerance;
}

}  // namespace

int main() {
  std::mt19937_64 engine(1);
  std::vector<ui::Experiment> experiments;
  for (int r = 0; r < 60; ++r) experiments.push_back(experiment(r, &engine));

  const ui::Identifier identifier(configuration(), [](double sample_time) {
    return std::make_shared<MotorModel>(sample_time);
  });
  const ui::Estimate estimate = identifier.identify(experiments);
  const auto& parameters = estimate.nominal_model.parameters;
  const bool inertia = print(parameters[0], kInertia, 0.03);
  const bool friction = print(parameters[1], kFriction, 0.03);
  const bool noise = print(estimate.noise_variance, kNoise * kNoise, 0.1);
  std::cout << estimate.message << "\n";
  return estimate.usable() && inertia && friction && noise ? 0 : 1;
}
