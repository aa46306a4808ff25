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

/// Levels of the experiments' own are no merit of a plant that has an offset for each.
TEST(SimulationFit, IsMeasuredAboutOwnMeansWhereOffsetsAreOwn) {
  std::vector<Experiment> experiments(2);
  for (int r = 0; r < 2; ++r) {
    experiments[static_cast<std::size_t>(r)].u = VectorXd::Zero(4);
    experiments[static_cast<std::size_t>(r)].y = test::vectorOf({-1, 1, -1, 1}).array() + 100 * r;
  }
  const SimulationFit fit =
      fitOfErrors({VectorXd::Constant(4, 0.5), VectorXd::Constant(4, 0.5)}, experiments);
  EXPECT_NEAR(fit.pooledFor(Offsets::per_experiment), 50, 1e-9);  // 100 (1 - 0.5/1)
  EXPECT_NEAR(fit.pooledFor(Offsets::estimate), 100 * (1 - 0.5 / std::sqrt(2501.0)), 1e-9);
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

/// Errors with the square 1, in one tenth of a record 0.9 and in another one of the caller's.
std::vector<VectorXd> errorsWith(double square_in_one_part) {
  VectorXd errors = VectorXd::Ones(100);
  errors.segment(30, 10).setConstant(std::sqrt(square_in_one_part));
  errors.segment(60, 10).setConstant(std::sqrt(0.9));
  return {errors};
}

/// The sum of ten differences d, 0, ..., 0 has the standard error d: one part shows nothing.
TEST(AreNoticeablyLarger, NeedsMoreThanOnePartOfARecord) {
  const std::vector<VectorXd> ones{VectorXd::Ones(100)},
      everywhere = {VectorXd::Constant(100, 1.01)};
  EXPECT_FALSE(areNoticeablyLarger(errorsWith(50), ones));
  EXPECT_TRUE(areNoticeablyLarger(everywhere, ones));
  EXPECT_FALSE(areNoticeablyLarger(ones, everywhere));
  EXPECT_FALSE(areNoticeablyLarger(ones, ones));
}

/// Of many experiments each is a part. The same difference d in k of twelve has the sum k d and the
/// standard error d sqrt(k (12 - k)/11): more than twice that for k > 3.
TEST(AreNoticeablyLarger, ComparesExperiments) {
  std::vector<VectorXd> one(12, VectorXd::Ones(20)), other = one;
  for (std::size_t r = 0; r < 12; ++r) {
    EXPECT_EQ(areNoticeablyLarger(one, other), r > 3) << r;
    one[r] *= 2;
  }
}

TEST(InitialCoefficients, AreThoseOfTheFirstMeasuredSamples) {
  Eigen::MatrixXd Z(200, 1);
  Eigen::VectorXd error(200);
  for (int t = 0; t < 200; ++t) {
    Z(t, 0) = std::pow(0.9, t % 100);
    error[t] = 3 * Z(t, 0) + (t % 100 > 40 ? 1 : 0);  // later errors take no part
  }
  EXPECT_NEAR(initialCoefficients(Z, error)[0], 3, 1e-9);
  Z.topRows(100).setZero();  // not measured
  error.head(100).setZero();
  EXPECT_NEAR(initialCoefficients(Z, error)[0], 3, 1e-9);
}

}  // namespace
}  // namespace uncertainty_identification
