// Compares the stream with LinearModel, which processes the whole experiment at once: random
// systems with gaps, all starts, all offsets and a recursive basis.
#include "detection/whitened_stream.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

struct Case {
  InitialState initial_state;
  NoiseStart noise_start;
  Offsets offsets;
  OffsetSide side;
  double laguerre_pole;
  double missing;
};

/// Column k, which is zero beyond its end.
double columnOf(const Response& response, Eigen::Index k, int lane, int t) {
  const Signals& column = *response.value.columns[static_cast<std::size_t>(k)];
  return t < column.cols() ? column(lane, t) : 0;
}

class WhitenedStreamTest : public testing::TestWithParam<Case> {};

TEST_P(WhitenedStreamTest, IsWhatTheModelSaysOfTheWholeExperiment) {
  const Case& of = GetParam();
  test::RandomSystemOptions options;
  options.nb = 2;
  options.na = 3;
  options.nc = options.nd = 2;
  options.taps = 3;
  options.zero_static_gain = false;
  options.laguerre_pole = of.laguerre_pole;
  options.experiments = 4;
  options.missing = of.missing;
  const auto system = test::randomSystem(options, 3);
  Configuration configuration = test::configurationOf(options);
  EstimationOptions& estimation = configuration.estimation;
  estimation.initial_state = of.initial_state;
  estimation.discard_samples = 12;
  estimation.noise_start = of.noise_start;
  estimation.offsets = of.offsets;
  estimation.offset_side = of.side;
  const test::CoreSetup setup(configuration, system.experiments);
  const bool common = of.offsets == Offsets::estimate;
  const bool at_input = of.side == OffsetSide::input;
  VectorXd at = test::parametersOf(system.truth).parameters;
  const Polynomials polynomials = setup.model().nominal().polynomials(at);
  if (common) at = test::appended(at, 0.7);
  const Block& block = setup.blocks()[0];
  Response response;
  setup.model().evaluate(block, at, false, &response);

  const RationalBasis basis(setup.model().basis());
  for (int lane = 0; lane < block.lanes; ++lane) {
    const Experiment& experiment = *block.experiments[static_cast<std::size_t>(lane)];
    WhitenedStream stream(streamModel(polynomials, basis), estimation, common && at_input ? 0.7 : 0,
                          common && !at_input ? 0.7 : 0);
    ASSERT_EQ(stream.regressors(), 3);
    ASSERT_EQ(stream.columns(), static_cast<Eigen::Index>(response.value.columns.size()));
    int measured = 0;
    for (int t = 0; t < experiment.samples(); ++t) {
      const VectorXd found = stream.step(experiment.u[t], experiment.y[t]);
      measured += stream.measured() ? 1 : 0;
      VectorXd expected(found.size());
      expected[0] = response.value.residual(lane, t);
      expected[1] = found[1];
      for (Eigen::Index i = 0; i < 3; ++i)
        expected[2 + i] = response.value.regressors[static_cast<std::size_t>(i)](lane, t);
      for (Eigen::Index k = 0; k < stream.columns(); ++k)
        expected[5 + k] = columnOf(response, k, lane, t);
      ASSERT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-9 * (1 + expected.norm()))
          << "sample " << t << ": " << found.transpose() << " is not " << expected.transpose();
    }
    EXPECT_EQ(measured, static_cast<int>(response.effective_samples[lane]));
  }
}

class SensitivityStream : public testing::TestWithParam<int> {};

// Errors of Go's own parameters, of first and second order.
TEST_P(SensitivityStream, IsWhatTheModelSaysOfTheWholeExperiment) {
  test::RandomSystemOptions options;
  options.experiments = 3;
  options.missing = 0.2;
  std::vector<Experiment> experiments = test::randomSystem(options, 5).experiments;
  for (Experiment& experiment : experiments) experiment.sample_time = 0.01;
  Configuration configuration;
  configuration.nominal_model.structure = Structure::continuous;
  configuration.error_model.basis = BasisKind::sensitivity;
  configuration.error_model.sensitivity_order = GetParam();
  configuration.error_model.constraint = Constraint::zero_mean;
  configuration.error_model.parameters = {"gain", "tau1"};
  configuration.estimation.offsets = Offsets::none;
  const test::CoreSetup setup(configuration, experiments);
  const VectorXd at = test::vectorOf({1.5, 0.03, 0.2, -0.4});
  Response response;
  setup.model().evaluate(setup.blocks()[0], at, false, &response);
  for (int lane = 0; lane < setup.blocks()[0].lanes; ++lane) {
    const Experiment& experiment = *setup.blocks()[0].experiments[static_cast<std::size_t>(lane)];
    WhitenedStream stream(streamModel(setup.model().nominal(), configuration.error_model, at),
                          configuration.estimation, 0, 0);
    const Eigen::Index n = stream.regressors(), columns = stream.columns();
    ASSERT_EQ(n, setup.model().regressors());
    ASSERT_EQ(columns, static_cast<Eigen::Index>(response.value.columns.size()));
    for (int t = 0; t < experiment.samples(); ++t) {
      const VectorXd found = stream.step(experiment.u[t], experiment.y[t]);
      EXPECT_NEAR(found[0], response.value.residual(lane, t), 1e-9);
      for (Eigen::Index i = 0; i < n; ++i) {
        const double expected = response.value.regressors[static_cast<std::size_t>(i)](lane, t);
        ASSERT_NEAR(found[2 + i], expected, 1e-6 * (1 + std::abs(expected))) << i << " at " << t;
      }
      for (Eigen::Index k = 0; k < columns; ++k) {
        const double expected = columnOf(response, k, lane, t);
        ASSERT_NEAR(found[2 + n + k], expected, 1e-9 * (1 + std::abs(expected))) << k;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, SensitivityStream, testing::Values(1, 2));

INSTANTIATE_TEST_SUITE_P(All, WhitenedStreamTest,
                         testing::Values(Case{InitialState::zero, NoiseStart::zero, Offsets::none,
                                              OffsetSide::output, 0, 0},
                                         Case{InitialState::zero, NoiseStart::stationary,
                                              Offsets::estimate, OffsetSide::output, 0, 0.2},
                                         Case{InitialState::zero, NoiseStart::zero,
                                              Offsets::estimate, OffsetSide::input, 0.4, 0.2},
                                         Case{InitialState::discard, NoiseStart::stationary,
                                              Offsets::none, OffsetSide::output, 0, 0.2},
                                         Case{InitialState::estimate, NoiseStart::stationary,
                                              Offsets::per_experiment, OffsetSide::output, 0, 0.2},
                                         Case{InitialState::estimate, NoiseStart::stationary,
                                              Offsets::per_experiment, OffsetSide::input, -0.3,
                                              0}));

}  // namespace
}  // namespace uncertainty_identification
