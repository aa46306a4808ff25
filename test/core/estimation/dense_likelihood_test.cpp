// Checks of the reference to which the fast likelihood is compared: golden values, and cases with a
// known answer.
#include "support/dense_likelihood.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/core_setup.h"
#include "support/golden.h"
#include "support/random_system.h"

namespace uncertainty_identification {
namespace {

using test::vectorOf;

using dense::Options;
using Eigen::VectorXd;

const double kLogTwoPi = std::log(2.0 * std::acos(-1.0));

/// Go = 0, so the outputs are the noise C/D alone.
dense::Model noiseModel(const VectorXd& c, const VectorXd& d, double noise_variance) {
  dense::Model model;
  model.b = VectorXd::Zero(1);
  model.c = c;
  model.d = d;
  model.T.resize(0, 0);
  model.noise_variance = noise_variance;
  return model;
}

Experiment outputOnly(const VectorXd& y) {
  Experiment experiment;
  experiment.u = VectorXd::Zero(y.size());
  experiment.y = y;
  return experiment;
}

double logNormal(double value, double variance) {
  return -0.5 * (kLogTwoPi + std::log(variance) + value * value / variance);
}

/// Autocovariance of C/D from the Yule-Walker equations, which know nothing of infinite sums:
/// sum_k d_k r(lag - k) = sum_(j >= lag) c_j h_(j - lag).
VectorXd yuleWalkerAutocovariance(const VectorXd& c, const VectorXd& d, int lags) {
  const VectorXd ma = dense::monic(c), ar = dense::monic(d);
  const Eigen::Index size = std::max(ma.size(), ar.size());
  const VectorXd h = dense::impulseResponse(ma, ar, 0, static_cast<int>(ma.size())).cast<double>();
  Eigen::MatrixXd equations = Eigen::MatrixXd::Zero(size, size);
  VectorXd right = VectorXd::Zero(size);
  for (Eigen::Index lag = 0; lag < size; ++lag) {
    for (Eigen::Index k = 0; k < ar.size(); ++k) equations(lag, std::abs(lag - k)) += ar[k];
    for (Eigen::Index j = lag; j < ma.size(); ++j) right[lag] += ma[j] * h[j - lag];
  }
  VectorXd r = VectorXd::Zero(lags);
  r.head(size) = equations.fullPivLu().solve(right);
  for (Eigen::Index lag = size; lag < lags; ++lag) {
    for (Eigen::Index k = 1; k < ar.size(); ++k) r[lag] -= ar[k] * r[lag - k];
  }
  return r;
}

class GoldenLikelihood : public testing::TestWithParam<const char*> {};

TEST_P(GoldenLikelihood, MatchesListedValues) {
  const auto golden = test::readGolden(GetParam());
  auto points = golden.points;
  points.push_back(golden.optimum);
  for (const auto& point : points) {
    const double value = dense::logLikelihood(golden.experiments, denseModel(golden, point));
    EXPECT_NEAR(value, point.log_likelihood, 1e-9 * std::abs(point.log_likelihood));
  }
}

INSTANTIATE_TEST_SUITE_P(Golden, GoldenLikelihood,
                         testing::Values("example1", "box_jenkins_2nd_order"));

TEST(GoldenGradient, MatchesListedDifferences) {
  const auto golden = test::readGolden("example1");
  const auto& point = golden.points.front();
  for (Eigen::Index j = 0; j < point.theta.size(); ++j) {
    const double step = 1e-5;
    auto up = point, down = point;
    up.theta[j] += step;
    down.theta[j] -= step;
    const double slope = (dense::logLikelihood(golden.experiments, denseModel(golden, up)) -
                          dense::logLikelihood(golden.experiments, denseModel(golden, down))) /
                         (2 * step);
    EXPECT_NEAR(slope, point.gradient_theta[j], 1e-5 * point.gradient_theta.norm()) << j;
  }
}

TEST(DenseAutocovariance, AgreesWithYuleWalkerEquations) {
  const std::vector<std::pair<VectorXd, VectorXd>> models = {
      {vectorOf({}), vectorOf({-0.9})},
      {vectorOf({0.4}), vectorOf({-0.8})},
      {vectorOf({0.5, 0.2}), vectorOf({-1.5, 0.9, -0.2})},
      {vectorOf({0.5, 0.2, -0.1}), vectorOf({-1.2, 0.5})},
      {vectorOf({0.7, 0.3}), vectorOf({})},
      {vectorOf({-0.5}), vectorOf({-0.999})}};
  for (const auto& [c, d] : models) {
    const VectorXd sums = dense::autocovariance(c, d, 40).cast<double>();
    const VectorXd exact = yuleWalkerAutocovariance(c, d, 40);
    EXPECT_LT((sums - exact).cwiseAbs().maxCoeff(), 1e-11 * exact[0]);
  }
}

TEST(DenseAutocovariance, OfMovedUnitPolynomialsIsWhite) {
  const auto r = dense::autocovariance(vectorOf({0.3, -0.2}), vectorOf({0.3, -0.2}), 5);
  EXPECT_NEAR(double(r[0]), 1.0, 1e-15);
  EXPECT_LT(double(r.tail(4).cwiseAbs().maxCoeff()), 1e-15);
}

TEST(DenseSignals, LaguerreFiltersAreOrthonormal) {
  const Eigen::MatrixXd basis = dense::laguerreBasis(0.6, 4, 400);
  EXPECT_LT((basis.transpose() * basis - Eigen::Matrix4d::Identity()).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((dense::laguerreBasis(0.0, 3, 9) - dense::firBasis(3, 9)).norm(), 1e-15);
}

TEST(DenseLikelihood, WhiteNoise) {
  const VectorXd y = vectorOf({0.3, -1.2, 0.7});
  double expected = 0;
  for (Eigen::Index k = 0; k < y.size(); ++k) expected += logNormal(y[k], 0.4);
  const dense::Model model = noiseModel({}, {}, 0.4);
  EXPECT_NEAR(dense::logLikelihood({outputOnly(y)}, model), expected, 1e-13);
}

TEST(DenseLikelihood, AutoregressionFromRestAndStationary) {
  const double pole = 0.8, variance = 0.3;
  const VectorXd y = vectorOf({1.1, 0.4, -0.6, -0.9, 0.2});
  double transitions = 0;
  for (int k = 1; k < 5; ++k) transitions += logNormal(y[k] - pole * y[k - 1], variance);
  const dense::Model model = noiseModel({}, vectorOf({-pole}), variance);
  Options options;
  EXPECT_NEAR(dense::logLikelihood({outputOnly(y)}, model, options),
              transitions + logNormal(y[0], variance), 1e-13);
  options.noise_start = NoiseStart::stationary;
  EXPECT_NEAR(dense::logLikelihood({outputOnly(y)}, model, options),
              transitions + logNormal(y[0], variance / (1 - pole * pole)), 1e-13);
}

TEST(DenseLikelihood, AutoregressionWithMissingSamples) {
  const double pole = 0.8, variance = 0.3;
  Experiment experiment = outputOnly(vectorOf({1.1, 0.4, std::nan(""), std::nan(""), 0.2}));
  experiment.valid = {1, 1, 0, 0, 1};
  const double bridge = variance * (1 + std::pow(pole, 2) + std::pow(pole, 4));
  const double expected = logNormal(1.1, variance) + logNormal(0.4 - pole * 1.1, variance) +
                          logNormal(0.2 - std::pow(pole, 3) * 0.4, bridge);
  const dense::Model model = noiseModel({}, vectorOf({-pole}), variance);
  const auto evaluation = dense::evaluate(experiment, model);
  EXPECT_NEAR(evaluation.log_likelihood, expected, 1e-13);
  EXPECT_EQ(evaluation.degrees_of_freedom, 3);
}

TEST(DenseLikelihood, DiscardedSamplesCountAsNotMeasured) {
  test::RandomSystemOptions system_options;
  system_options.experiments = 2;
  auto system = test::randomSystem(system_options, 3);
  Options discard;
  discard.initial_state = InitialState::discard;
  discard.discard_samples = 7;
  const double discarded = dense::logLikelihood(system.experiments, system.truth, discard);
  for (auto& experiment : system.experiments) {
    experiment.valid.assign(static_cast<std::size_t>(experiment.samples()), 1);
    std::fill_n(experiment.valid.begin(), 7, std::uint8_t{0});
  }
  EXPECT_NEAR(discarded, dense::logLikelihood(system.experiments, system.truth), 1e-10);
}

/// The flat prior integrates p(y | offset) over the offset.
TEST(DenseLikelihood, DiffuseOffsetIsAnIntegral) {
  test::RandomSystemOptions system_options;
  system_options.experiments = 1;
  system_options.output_offset = 1.5;
  const auto system = test::randomSystem(system_options, 5);
  Options options;
  options.noise_start = NoiseStart::stationary;
  const double step = 0.005;
  const auto density = [&](int k) {
    options.output_offset = 1.5 + k * step;
    return dense::logLikelihood(system.experiments, system.truth, options);
  };
  const double center = density(0);
  double sum = 0;
  for (int k = -250; k <= 250; ++k) sum += std::exp(density(k) - center);
  options.output_offset = 0;
  options.diffuse_offset = true;
  EXPECT_NEAR(dense::logLikelihood(system.experiments, system.truth, options),
              center + std::log(sum * step), 1e-9);
}

/// With a wide proper prior N(0, wide I) on the state, less its constant -p/2 log(2 pi wide).
TEST(DenseLikelihood, DiffuseStateIsTheLimitOfAWidePrior) {
  test::RandomSystemOptions system_options;
  system_options.na = 2;
  system_options.taps = 0;
  system_options.experiments = 1;
  system_options.missing = 0.2;
  const auto system = test::randomSystem(system_options, 8);
  Options options;
  options.initial_state = InitialState::estimate;
  const auto diffuse = dense::evaluate(system.experiments[0], system.truth, options);

  const int samples = system.experiments[0].samples();
  const double wide = 1e9;
  dense::Model proper = system.truth;
  const dense::Matrix directions = dense::stateDirections(proper, samples);
  const dense::Matrix covariance =
      proper.noise_variance * dense::noiseCovariance(proper, NoiseStart::zero, samples) +
      wide * directions * directions.transpose();
  const auto& experiment = system.experiments[0];
  std::vector<Eigen::Index> observed;
  for (int k = 0; k < samples; ++k) {
    if (experiment.isValid(k)) observed.push_back(k);
  }
  const auto go = dense::toeplitz(
      dense::impulseResponse(proper.b, dense::monic(proper.a), proper.delay, samples));
  const dense::Vector response = go * experiment.u.cast<dense::Real>();
  const auto count = static_cast<Eigen::Index>(observed.size());
  dense::Matrix v(count, count);
  dense::Vector residual(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto row = observed[static_cast<std::size_t>(i)];
    residual[i] = experiment.y[row] - response[row];
    for (Eigen::Index j = 0; j < count; ++j) {
      v(i, j) = covariance(row, observed[static_cast<std::size_t>(j)]);
    }
  }
  const Eigen::FullPivLU<dense::Matrix> lu(v);
  const double log_determinant = double(lu.matrixLU().diagonal().cwiseAbs().array().log().sum());
  const double expected = -0.5 * (double(count) * kLogTwoPi + log_determinant +
                                  double(residual.dot(lu.solve(residual)))) +
                          0.5 * double(directions.cols()) * (kLogTwoPi + std::log(wide));
  EXPECT_EQ(diffuse.degrees_of_freedom, count - directions.cols());
  EXPECT_NEAR(diffuse.log_likelihood, expected, 1e-6);
}

/// Whatever the input was before sample 0, the state directions hold its effect.
TEST(DenseLikelihood, StateDirectionsHoldTheEffectOfEarlierInputs) {
  for (const double laguerre_pole : {0.0, 0.4}) {
    test::RandomSystemOptions options;
    options.nb = 2;
    options.na = 2;
    options.delay = 2;
    options.taps = 3;
    options.laguerre_pole = laguerre_pole;
    options.experiments = 2;
    options.pole_radius = 0.8;
    options.noise_variance = 1e-6;
    options.input_run_up = 200;
    options.min_samples = options.max_samples = 80;
    const auto system = test::randomSystem(options, 21);
    const auto& error = system.errors[0];
    dense::Model known = system.truth;
    known.mixture = {{1.0}, {error}, {Eigen::MatrixXd::Zero(error.size(), error.size())}};
    Options diffuse;
    diffuse.initial_state = InitialState::estimate;
    const Experiment& experiment = system.experiments[0];
    const auto quadratic = [&](const dense::Model& model) {
      // what a larger sigma^2 gains, at fixed determinants, is the quadratic form
      dense::Model doubled = model;
      doubled.noise_variance *= 2;
      const auto one = dense::evaluate(experiment, model, diffuse);
      const auto two = dense::evaluate(experiment, doubled, diffuse);
      const double count = one.degrees_of_freedom;
      return 4.0 * (two.log_likelihood - one.log_likelihood + 0.5 * count * std::log(2.0)) / count;
    };
    EXPECT_GT(quadratic(known), 0.4);
    EXPECT_LT(quadratic(known), 2.0) << "Laguerre pole " << laguerre_pole;
    known.basis_order = 0;
    known.basis_denominator.resize(0);
    EXPECT_GT(quadratic(known), 100.0) << "too few directions must not suffice";
  }
}

/// With H = 1 and Go = b1 q^-2 the unknown past inputs are the first two outputs, of which one was
/// not measured.
TEST(DenseLikelihood, DirectionsThatWereNotSeenDropOut) {
  test::RandomSystemOptions options;
  options.na = options.nc = options.nd = options.taps = 0;
  options.delay = 2;
  options.experiments = 1;
  auto system = test::randomSystem(options, 13);
  Experiment& experiment = system.experiments[0];
  experiment.valid.assign(static_cast<std::size_t>(experiment.samples()), 1);
  experiment.valid[0] = 0;
  Options diffuse, discard;
  diffuse.initial_state = InitialState::estimate;
  discard.initial_state = InitialState::discard;
  discard.discard_samples = 2;
  const auto evaluation = dense::evaluate(experiment, system.truth, diffuse);
  EXPECT_EQ(evaluation.degrees_of_freedom, experiment.samples() - 2);
  EXPECT_NEAR(evaluation.log_likelihood,
              dense::evaluate(experiment, system.truth, discard).log_likelihood, 1e-10);
}

TEST(DenseLikelihood, PosteriorIsThatOfTheErrorParametersDrawn) {
  test::RandomSystemOptions options;
  options.taps = 3;
  options.experiments = 40;
  options.noise_run_up = 1000;
  options.missing = 0.1;
  const auto system = test::randomSystem(options, 2);
  Options stationary;
  stationary.noise_start = NoiseStart::stationary;
  double distance = 0;
  for (std::size_t r = 0; r < system.experiments.size(); ++r) {
    const auto evaluation = dense::evaluate(system.experiments[r], system.truth, stationary);
    const auto i = static_cast<std::size_t>(system.components[r]);
    const VectorXd error = evaluation.error_means[i] - system.errors[r];
    distance += error.dot(evaluation.error_covariances[i].inverse() * error);
  }
  // a chi-squared variable with 80 degrees of freedom: mean 80, deviation 12.6
  EXPECT_NEAR(distance, 80.0, 38.0);
}

}  // namespace
}  // namespace uncertainty_identification
