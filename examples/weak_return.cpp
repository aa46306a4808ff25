// Finds an effect of one's own (weak_return_effect.cpp) in simulated experiments. Exit status: 0
// when explain() names it, with the parameter that was simulated.

#include <cmath>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "uncertainty_identification/explanation/explanation.h"

namespace ui = uncertainty_identification;

namespace {

constexpr double kShare = 0.2;  // that the negative direction lacks
constexpr double kNoise = 0.1;  // [mm] standard deviation of the position sensor

/// A position that follows its command with a lag, pushed and pulled by random steps.
ui::Experiment experiment(int number, std::mt19937_64* engine) {
  constexpr int kSamples = 200, kHold = 4;
  std::normal_distribution<double> normal;
  const double gain = 1 + 0.05 * normal(*engine);
  ui::Experiment recorded;
  recorded.id = "stroke_" + std::to_string(number);
  recorded.sample_time = 0.01;
  recorded.u.resize(kSamples);
  recorded.y.resize(kSamples);
  double position = 0;
  for (int t = 0; t < kSamples; ++t) {
    recorded.u[t] = t % kHold == 0 ? 2 * normal(*engine) : recorded.u[t - 1];
    recorded.y[t] = position + kNoise * normal(*engine);
    const double force = recorded.u[t] < 0 ? (1 - kShare) * recorded.u[t] : recorded.u[t];
    position = 0.8 * position + 0.2 * gain * force;
  }
  return recorded;
}

ui::Configuration configuration() {
  ui::Configuration configuration;
  configuration.nominal_model.orders_auto = false;
  configuration.nominal_model.structure = ui::Structure::output_error;
  configuration.error_model.basis = ui::BasisKind::fir;
  configuration.error_model.constraint = ui::Constraint::zero_mean;
  configuration.error_model.taps = 1;
  configuration.error_model.components = 1;
  configuration.estimation.initial_state = ui::InitialState::zero;
  configuration.estimation.offsets = ui::Offsets::none;
  configuration.bounds.frequencies = 0;
  configuration.explanation.time_limit = 0;  // the answer must not depend on the machine
  return configuration;
}

}  // namespace

int main() {
  std::mt19937_64 engine(1);
  std::vector<ui::Experiment> experiments;
  for (int r = 0; r < 20; ++r) experiments.push_back(experiment(r, &engine));

  const ui::Explanation explanation = ui::explain(configuration(), experiments);
  std::cout << explanation.message << "\n";
  if (explanation.causes.size() != 1 || explanation.causes[0].name != "act_weak_return") return 1;
  const ui::CauseParameter& share = explanation.causes[0].parameters.at(0);
  std::cout << share.name << ": " << share.value << " +- " << share.standard_error
            << " (simulated: " << kShare << ")\n";
  return std::abs(share.value - kShare) < 4 * share.standard_error ? 0 : 1;
}
