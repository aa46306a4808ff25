#include "estimation/simulation_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

test::RandomSystemOptions noisy() {
  test::RandomSystemOptions options;
  options.nb = options.na = 2;
  options.taps = 0;
  options.experiments = 11;
  options.missing = 0.1;
  options.noise_variance = 0.5;
  return options;
}

VectorXd direct(const dense::Model& truth, const Experiment& experiment) {
  const dense::Matrix go = dense::toeplitz(
      dense::impulseResponse(truth.b, dense::monic(truth.a), truth.delay, experiment.samples()));
  return (go * experiment.u.cast<dense::Real>()).cast<double>();
}

struct Expected {
  std::vector<double> percent;
  double pooled;
};

/// 100 (1 - |y - simulated| / |y - mean y|) written out.
Expected expectedFit(const test::RandomSystem& system, double offset) {
  Expected expected{{}, 0};
  double error = 0, sum = 0, count = 0;
  std::vector<double> measured;
  for (const Experiment& experiment : system.experiments) {
    const VectorXd simulated = direct(system.truth, experiment);
    double own_error = 0, own_sum = 0, own_spread = 0;
    for (int k = 0; k < experiment.samples(); ++k) {
      if (!experiment.isValid(k)) continue;
      own_error += std::pow(experiment.y[k] - simulated[k] - offset, 2);
      own_sum += experiment.y[k];
      measured.push_back(experiment.y[k]);
    }
    const double own_mean = own_sum / experiment.validSamples();
    for (int k = 0; k < experiment.samples(); ++k) {
      if (experiment.isValid(k)) own_spread += std::pow(experiment.y[k] - own_mean, 2);
    }
    expected.percent.push_back(100 * (1 - std::sqrt(own_error / own_spread)));
    error += own_error;
    sum += own_sum;
    count += experiment.validSamples();
  }
  double spread = 0;
  for (double y : measured) spread += std::pow(y - sum / count, 2);
  expected.pooled = 100 * (1 - std::sqrt(error / spread));
  return expected;
}

TEST(SimulationFit, FromRestEqualsADirectSimulation) {
  const auto system = test::randomSystem(noisy(), 4);
  const Configuration configuration = test::configurationOf(noisy());
  const auto nominal = makeNominalModel(configuration.nominal_model, 1);
  const VectorXd theta = test::parametersOf(system.truth).parameters;
  EstimationOptions options = configuration.estimation;
  for (bool with_offset : {false, true}) {
    options.offsets = with_offset ? Offsets::estimate : Offsets::none;
    const double offset = with_offset ? 0.7 : 0.0;
    const SimulationFit fit = simulationFit(*nominal, theta, offset, options, system.experiments);
    const Expected expected = expectedFit(system, offset);
    ASSERT_EQ(fit.percent.size(), 11u);
    for (std::size_t r = 0; r < 11; ++r) EXPECT_NEAR(fit.percent[r], expected.percent[r], 1e-8);
    EXPECT_NEAR(fit.pooled, expected.pooled, 1e-8);
  }
}

/// The colour of the noise is no business of a free simulation.
TEST(SimulationFit, IgnoresTheNoiseModel) {
  const auto system = test::randomSystem(noisy(), 4);
  const Configuration configuration = test::configurationOf(noisy());
  const auto nominal = makeNominalModel(configuration.nominal_model, 1);
  VectorXd theta = test::parametersOf(system.truth).parameters;
  const auto fit = [&] {
    return simulationFit(*nominal, theta, 0, configuration.estimation, system.experiments).pooled;
  };
  const double before = fit();
  theta.tail(2).setConstant(0.9);
  EXPECT_EQ(fit(), before);
}

/// What Go answers to inputs before the first sample is taken from the first samples.
TEST(SimulationFit, EstimatesTheInitialState) {
  test::RandomSystemOptions options = noisy();
  options.input_run_up = 200;
  options.noise_variance = 1e-12;
  auto system = test::randomSystem(options, 4);
  system.truth.a = test::vectorOf({-1.8, 0.82});  // slow: the state is seen for long
  system = test::simulateSystem(system.truth, options, 5);
  Configuration configuration = test::configurationOf(options);
  const auto nominal = makeNominalModel(configuration.nominal_model, 1);
  const VectorXd theta = test::parametersOf(system.truth).parameters;
  const auto fit = [&] {
    return simulationFit(*nominal, theta, 0, configuration.estimation, system.experiments).pooled;
  };
  EXPECT_LT(fit(), 90);
  configuration.estimation.initial_state = InitialState::estimate;
  EXPECT_GT(fit(), 99.99);
}

}  // namespace
}  // namespace uncertainty_identification
