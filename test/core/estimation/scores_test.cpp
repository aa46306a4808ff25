// The exact gradient of each experiment's log-likelihood against differences of its value, for all
// combinations of what a record can hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Scores (all experiments) at `at` against central differences.
void expectScores(const Configuration& configuration, const std::vector<Experiment>& experiments,
                  const ModelParameters& at) {
  const test::CoreSetup setup(configuration, experiments);
  ASSERT_TRUE(setup.model().admissible(at.parameters));
  const Statistics statistics = setup.likelihood().statistics(at.parameters, true);
  const MatrixXd found = scores(statistics, at, setup.likelihood().expect(statistics, at));
  const auto values = [&](const VectorXd& natural) -> VectorXd {
    return setup.expect(test::fromNaturalCoordinates(natural, at)).log_likelihood;
  };
  const MatrixXd expected =
      test::differences(values, test::naturalCoordinates(at), 1e-3).transpose();
  ASSERT_EQ(found.rows(), expected.rows());
  ASSERT_TRUE(found.allFinite());
  for (Eigen::Index j = 0; j < found.rows(); ++j) {
    EXPECT_LT((found.row(j) - expected.row(j)).norm(),
              1e-6 * expected.row(j).norm() + 1e-7 * expected.rowwise().norm().minCoeff() + 1e-8)
        << "coordinate " << j << " of " << found.rows();
  }
}

test::RandomSystemOptions smallSystem() {
  test::RandomSystemOptions options;
  options.nb = 2;
  options.na = 2;
  options.nc = 1;
  options.nd = 2;
  options.pole_radius = 0.75;
  options.experiments = 3;
  options.min_samples = 25;
  options.max_samples = 35;
  options.noise_run_up = options.input_run_up = 100;
  options.output_offset = 0.7;
  return options;
}

using Nuisances = std::tuple<bool, InitialState, Offsets, OffsetSide, NoiseStart>;

class ScoresOfNuisances : public testing::TestWithParam<Nuisances> {};

TEST_P(ScoresOfNuisances, MatchDifferences) {
  const auto [gaps, initial_state, offsets, side, noise_start] = GetParam();
  test::RandomSystemOptions options = smallSystem();
  options.missing = gaps ? 0.15 : 0;
  auto system = test::randomSystem(options, 21);
  for (Experiment& experiment : system.experiments) {
    if (!gaps) continue;
    experiment.y.head(3).setConstant(
        0.3);  // where a first sample is missing, the number of visible
    std::fill_n(experiment.valid.begin(), 3, std::uint8_t{1});  // states is another: see below
  }
  Configuration configuration = test::configurationOf(options);
  configuration.estimation.initial_state = initial_state;
  configuration.estimation.discard_samples = 6;
  configuration.estimation.offsets = offsets;
  configuration.estimation.offset_side = side;
  configuration.estimation.noise_start = noise_start;
  ModelParameters at = test::parametersOf(system.truth);
  at.parameters *= 1.05;
  if (offsets == Offsets::estimate) at.parameters = test::appended(at.parameters, 0.4);
  expectScores(configuration, system.experiments, at);
}

INSTANTIATE_TEST_SUITE_P(
    All, ScoresOfNuisances,
    testing::Combine(testing::Bool(),
                     testing::Values(InitialState::zero, InitialState::discard,
                                     InitialState::estimate),
                     testing::Values(Offsets::none, Offsets::estimate, Offsets::per_experiment),
                     testing::Values(OffsetSide::output, OffsetSide::input),
                     testing::Values(NoiseStart::zero, NoiseStart::stationary)));

/// With outputs missing among the first samples fewer initial states are visible.
TEST(ScoresOfHiddenStates, MatchDifferences) {
  test::RandomSystemOptions options = smallSystem();
  auto system = test::randomSystem(options, 21);
  for (Experiment& experiment : system.experiments) {
    experiment.valid.assign(static_cast<std::size_t>(experiment.samples()), 1);
    experiment.valid[0] = experiment.valid[1] = 0;
  }
  Configuration configuration = test::configurationOf(options);
  configuration.estimation.initial_state = InitialState::estimate;
  configuration.estimation.noise_start = NoiseStart::stationary;
  expectScores(configuration, system.experiments, test::parametersOf(system.truth));
}

struct Shape {
  const char* name;
  BasisKind basis;
  int taps, components;
  Constraint constraint;
};

class ScoresOfErrorModels : public testing::TestWithParam<Shape> {};

TEST_P(ScoresOfErrorModels, MatchDifferences) {
  const Shape& shape = GetParam();
  test::RandomSystemOptions options = smallSystem();
  options.taps = shape.taps;
  options.components = shape.components;
  options.zero_static_gain = shape.constraint == Constraint::zero_static_gain;
  options.experiments = 4;
  auto system = test::randomSystem(options, 4);
  if (shape.constraint == Constraint::zero_mean) {
    const VectorXd mean = system.truth.mixture.mean();
    for (VectorXd& of_component : system.truth.mixture.means) of_component -= mean;
  }
  Configuration configuration = test::configurationOf(options);
  configuration.error_model.basis = shape.basis;
  configuration.error_model.constraint = shape.constraint;
  configuration.error_model.pole = 0.4;
  configuration.estimation.initial_state = InitialState::estimate;
  configuration.estimation.noise_start = NoiseStart::stationary;
  expectScores(configuration, system.experiments, test::parametersOf(system.truth));
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, ScoresOfErrorModels,
    testing::Values(Shape{"none", BasisKind::fir, 0, 1, Constraint::zero_static_gain},
                    Shape{"oneTap", BasisKind::fir, 1, 2, Constraint::free},
                    Shape{"threeTaps", BasisKind::fir, 3, 3, Constraint::zero_static_gain},
                    Shape{"zeroMean", BasisKind::fir, 2, 3, Constraint::zero_mean},
                    Shape{"laguerre", BasisKind::laguerre, 3, 2, Constraint::zero_static_gain},
                    Shape{"kautz", BasisKind::kautz, 4, 2, Constraint::free},
                    Shape{"fiveTaps", BasisKind::fir, 6, 1, Constraint::zero_static_gain}),
    [](const auto& info) { return std::string(info.param.name); });

class ScoresOfStructures : public testing::TestWithParam<Structure> {};

TEST_P(ScoresOfStructures, MatchDifferences) {
  test::RandomSystemOptions options = smallSystem();
  options.missing = 0.1;
  const auto system = test::randomSystem(options, 8);
  Configuration configuration = test::configurationOf(options);
  configuration.nominal_model.structure = GetParam();
  configuration.estimation.noise_start = NoiseStart::stationary;
  for (InitialState state : {InitialState::zero, InitialState::discard}) {
    configuration.estimation.initial_state = state;
    configuration.estimation.discard_samples = 5;
    ModelParameters at = test::parametersOf(system.truth);
    const auto nominal = makeNominalModel(configuration.nominal_model, 1.0);
    at.parameters = nominal->fromUnbounded(VectorXd::Constant(nominal->parameterCount(), 0.3));
    expectScores(configuration, system.experiments, at);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ScoresOfStructures,
                         testing::Values(Structure::output_error, Structure::arx, Structure::armax,
                                         Structure::box_jenkins));

TEST(ScoresOfContinuousModels, MatchDifferences) {
  test::RandomSystemOptions options = smallSystem();
  const auto system = test::randomSystem(options, 8);
  Configuration configuration = test::configurationOf(options);
  NominalModelOptions& nominal = configuration.nominal_model;
  nominal.structure = Structure::continuous;
  nominal.time_constants = 1;
  nominal.resonances = 1;
  nominal.zeros = 1;
  nominal.dead_time = true;
  nominal.max_delay = 3;
  nominal.nc = nominal.nd = 1;
  configuration.estimation.initial_state = InitialState::estimate;
  configuration.estimation.noise_start = NoiseStart::stationary;
  ModelParameters at = test::parametersOf(system.truth);
  at.parameters = test::vectorOf({1.3, 2.5, 0.9, 0.3, 0.4, 1.4, 0.2, -0.5});
  expectScores(configuration, system.experiments, at);
}

/// At a covariance of zero the gradient is that of the side where it grows.
TEST(ScoresOfDegenerateMixtures, AreFiniteAtZeroCovariance) {
  test::RandomSystemOptions options = smallSystem();
  options.input_deviation = 0.2;  // components that the data can hardly tell apart
  const auto system = test::randomSystem(options, 8);
  const test::CoreSetup setup(test::configurationOf(options), system.experiments);
  ModelParameters at = test::parametersOf(system.truth);
  at.mixture.covariances[0].setZero();
  const Statistics statistics = setup.likelihood().statistics(at.parameters, true);
  const Expectation e = setup.likelihood().expect(statistics, at);
  const MatrixXd found = scores(statistics, at, e);
  ASSERT_TRUE(found.allFinite());
  const double tiny = 1e-7;
  ModelParameters beside = at;
  beside.mixture.covariances[0](0, 0) = tiny;
  const double slope = (setup.logLikelihood(beside) - e.total()) / tiny;
  const Eigen::Index row = at.parameters.size() + 2 + 2;
  EXPECT_NEAR(found.row(row).sum(), slope, 1e-3 * std::abs(slope));
}

}  // namespace
}  // namespace uncertainty_identification
