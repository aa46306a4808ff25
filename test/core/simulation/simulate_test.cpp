#include "simulation/simulate.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <vector>

#include "support/core_setup.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using test::vectorOf;

VectorXd convolution(const VectorXd& left, const VectorXd& right, Eigen::Index length) {
  VectorXd out = VectorXd::Zero(length);
  for (Eigen::Index k = 0; k < length; ++k) {
    for (Eigen::Index j = 0; j <= k; ++j) {
      if (j < left.size() && k - j < right.size()) out(k) += left(j) * right(k - j);
    }
  }
  return out;
}

/// Impulse response of q^-delay B/A, term by term.
VectorXd impulseResponse(const VectorXd& b, const VectorXd& a, int delay, Eigen::Index length) {
  VectorXd g = VectorXd::Zero(length);
  for (Eigen::Index k = 0; k < length; ++k) {
    const Eigen::Index j = k - delay;
    if (j >= 0 && j < b.size()) g(k) = b(j);
    for (Eigen::Index i = 0; i < a.size() && i < k; ++i) g(k) -= a(i) * g(k - 1 - i);
  }
  return g;
}

/// A truth without noise, missing samples or error model.
Truth plainTruth() {
  Truth truth;
  truth.experiments = 5;
  truth.plant.b = vectorOf({1.0, 0.5});
  truth.plant.a = vectorOf({-0.7, 0.2});
  truth.plant.delay = 2;
  return truth;
}

Truth mixtureTruth() {
  Truth truth = plainTruth();
  truth.error_model.basis.taps = 3;
  truth.error_model.mixture.weights = {0.3, 0.7};
  truth.error_model.mixture.means = {vectorOf({-1, 0}), vectorOf({1, 2})};
  truth.error_model.mixture.covariances = {(Eigen::Matrix2d() << 0.2, 0.1, 0.1, 0.4).finished(),
                                           Eigen::Matrix2d::Zero()};
  return truth;
}

void expectClose(const VectorXd& actual, const VectorXd& expected, double tolerance) {
  ASSERT_EQ(actual.size(), expected.size());
  EXPECT_LE((actual - expected).cwiseAbs().maxCoeff(), tolerance);
}

void expectEqual(const Experiment& left, const Experiment& right) {
  EXPECT_EQ(left.id, right.id);
  EXPECT_EQ(left.start_time, right.start_time);
  EXPECT_EQ(left.u, right.u);
  EXPECT_EQ(left.valid, right.valid);
  for (int k = 0; k < left.samples(); ++k) {
    if (left.isValid(k)) {
      ASSERT_EQ(left.y(k), right.y(k)) << k;
    }
  }
}

TEST(Simulate, NoiseFreeOutputIsTheConvolution) {
  const Truth truth = plainTruth();
  const VectorXd g = impulseResponse(truth.plant.b, truth.plant.a, truth.plant.delay, 100);
  for (const Experiment& experiment : simulate(truth, 1)) {
    expectClose(experiment.y, convolution(g, experiment.u, 100), 1e-12);
    EXPECT_EQ(experiment.sample_time, truth.sample_time);
    EXPECT_EQ(experiment.validSamples(), 100);
  }
}

TEST(Simulate, RelativeErrorMultipliesThePlant) {
  const Truth truth = mixtureTruth();
  const VectorXd g = impulseResponse(truth.plant.b, truth.plant.a, truth.plant.delay, 100);
  for (int r = 0; r < truth.experiments; ++r) {
    const Experiment experiment = simulateExperiment(truth, 1, r);
    const VectorXd xi = drawSystem(truth, 1, r).xi;
    const VectorXd relative = experiment.y - convolution(g, experiment.u, 100);
    ASSERT_GT(relative.norm(), 0.1);
    // eta_k of the FIR error, by deconvolution: its static gain is zero and it has three taps.
    const VectorXd nominal = convolution(g, experiment.u, 100);
    Eigen::MatrixXd shifted = Eigen::MatrixXd::Zero(100, 5);
    for (int k = 0; k < 5; ++k) shifted.col(k).tail(100 - k) = nominal.head(100 - k);
    const VectorXd eta = shifted.colPivHouseholderQr().solve(relative);
    EXPECT_NEAR(eta.sum(), 0, 1e-9);
    expectClose(eta.tail(2), VectorXd::Zero(2), 1e-9);
    expectClose(eta.head(2), xi, 1e-9);  // T = [I; -1']
  }
}

TEST(Simulate, LaguerreErrorIsTheConvolution) {
  Truth truth = plainTruth();
  truth.error_model.basis.basis = BasisKind::laguerre;
  truth.error_model.basis.taps = 2;
  truth.error_model.basis.constraint = Constraint::free;
  const double p = truth.error_model.basis.pole = 0.6;
  truth.error_model.mixture.weights = {1};
  truth.error_model.mixture.means = {vectorOf({0.5, -2})};
  truth.error_model.mixture.covariances = {Eigen::Matrix2d::Zero()};
  const VectorXd first = impulseResponse(vectorOf({std::sqrt(1 - p * p)}), vectorOf({-p}), 0, 100);
  const VectorXd all_pass = impulseResponse(vectorOf({-p, 1}), vectorOf({-p}), 0, 100);
  const VectorXd error = 0.5 * first - 2 * convolution(first, all_pass, 100);
  const VectorXd g = impulseResponse(truth.plant.b, truth.plant.a, truth.plant.delay, 100);
  const Experiment experiment = simulateExperiment(truth, 1, 0);
  const VectorXd nominal = convolution(g, experiment.u, 100);
  expectClose(experiment.y, nominal + convolution(error, nominal, 100), 1e-10);
}

TEST(Simulate, FirstOrderStepResponse) {
  Truth truth;
  truth.sample_time = 0.01;
  truth.plant.structure = PlantStructure::first_order;
  truth.plant.gain = 3;
  truth.plant.time_constant = 0.02;
  truth.plant.time_constant_spread = 0.4;
  truth.input.variance = 0;
  truth.input.mean = 2;
  for (int r = 0; r < 5; ++r) {
    const double tau = drawSystem(truth, 7, r).time_constant.value();
    const Experiment experiment = simulateExperiment(truth, 7, r);
    for (int k = 0; k < 100; ++k) {
      EXPECT_NEAR(experiment.y(k), 6 * (1 - std::exp(-k * 0.01 / tau)), 1e-12);
    }
  }
}

TEST(Simulate, ExperimentsDependOnSeedAndNumberAlone) {
  Truth truth = mixtureTruth();
  truth.noise.variance = 0.1;
  truth.sensor.missing = 0.2;
  const std::vector<Experiment> few = simulate(truth, 5);
  truth.experiments = 40;
  const std::vector<Experiment> many = simulate(truth, 5), other = simulate(truth, 6);
  for (std::size_t r = 0; r < few.size(); ++r) {
    expectEqual(few[r], many[r]);
    EXPECT_NE(few[r].u, other[r].u);
    EXPECT_NE(few[r].u, few[(r + 1) % few.size()].u);
  }
}

TEST(Simulate, SwitchingOnePartLeavesTheOthersAsTheyWere) {
  Truth truth = plainTruth();
  const Experiment plain = simulateExperiment(truth, 3, 2);
  truth.noise.variance = 0.5;
  const Experiment noisy = simulateExperiment(truth, 3, 2);
  truth.sensor.missing = 0.5;
  const Experiment gappy = simulateExperiment(truth, 3, 2);
  EXPECT_EQ(plain.u, noisy.u);
  EXPECT_EQ(noisy.u, gappy.u);
  int compared = 0;
  for (int k = 0; k < gappy.samples(); ++k) {
    if (!gappy.isValid(k)) continue;
    EXPECT_EQ(gappy.y(k), noisy.y(k));
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

// What a seed means must not change: numbers of version 0.1.0, which had no effects to hide.
TEST(Simulate, SeedsKeepTheirMeaning) {
  Truth truth = mixtureTruth();
  truth.experiments = 7;
  truth.noise.variance = 0.1;
  truth.noise.d = vectorOf({-0.8});
  truth.noise.start = NoiseStart::stationary;
  const Experiment experiment = simulateExperiment(truth, 9, 6);
  EXPECT_DOUBLE_EQ(experiment.u(99), -0.99138246111217243);
  EXPECT_DOUBLE_EQ(experiment.y(99), -0.76844855710384785);
}

TEST(Simulate, LengthsMayDiffer) {
  Truth truth = plainTruth();
  truth.experiments = 3;
  truth.samples = {50, 60, 500};
  const std::vector<Experiment> experiments = simulate(truth, 1);
  for (std::size_t r = 0; r < 3; ++r) EXPECT_EQ(experiments[r].samples(), truth.samples[r]);
  for (std::size_t r = 1; r < 3; ++r) {
    const Experiment& before = experiments[r - 1];
    EXPECT_GT(experiments[r].start_time, before.start_time + before.samples() * before.sample_time);
  }
}

TEST(Simulate, DrawsFollowTheirDistributions) {
  Truth truth = mixtureTruth();
  truth.plant.structure = PlantStructure::first_order;
  truth.plant.time_constant = 2;
  truth.plant.time_constant_spread = 0.4;
  constexpr int kCount = 20000;
  Eigen::MatrixXd draws(kCount, 3);
  int first = 0;
  for (int r = 0; r < kCount; ++r) {
    const DrawnSystem system = drawSystem(truth, 11, r);
    draws.row(r) << system.xi(0), system.xi(1), system.time_constant.value();
    first += system.component == 0 ? 1 : 0;
    if (system.component == 1) {
      ASSERT_EQ(system.xi, truth.error_model.mixture.means[1]);
    }
    ASSERT_LE(std::abs(*system.time_constant - 2), 0.8);
  }
  const Eigen::RowVectorXd mean = draws.colwise().mean();
  const Eigen::MatrixXd centred = draws.rowwise() - mean;
  const Eigen::MatrixXd covariance = centred.transpose() * centred / kCount;
  const Mixture& mixture = truth.error_model.mixture;
  // Four standard errors: 0.013 for the share, 0.03 for the means and covariances of xi.
  EXPECT_NEAR(first / double(kCount), 0.3, 0.013);
  expectClose(mean.head(2).transpose(), mixture.mean(), 0.03);
  EXPECT_LE((covariance.topLeftCorner(2, 2) - mixture.covariance()).cwiseAbs().maxCoeff(), 0.03);
  EXPECT_NEAR(mean(2), 2, 4 * 0.462 / std::sqrt(kCount));
  EXPECT_NEAR(covariance(2, 2), 0.64 / 3, 0.006);
  EXPECT_LE(covariance.col(2).head(2).cwiseAbs().maxCoeff(), 0.02);
}

TEST(Simulate, NoiseStartsAtRestOrStationary) {
  Truth truth;
  truth.samples = {30};
  truth.experiments = 20000;
  truth.plant.b = VectorXd::Zero(1);
  truth.noise.variance = 0.5;
  truth.noise.c = vectorOf({0.4});
  truth.noise.d = vectorOf({-0.9});
  // ARMA(1,1): sigma^2 (1 + 2 c phi + c^2)/(1 - phi^2), phi = -d.
  const double stationary = 0.5 * (1 + 2 * 0.4 * 0.9 + 0.16) / (1 - 0.81);
  for (const NoiseStart start : {NoiseStart::zero, NoiseStart::stationary}) {
    truth.noise.start = start;
    Eigen::MatrixXd y(truth.experiments, 30);
    for (int r = 0; r < truth.experiments; ++r) y.row(r) = simulateExperiment(truth, 2, r).y;
    const double first = y.col(0).squaredNorm() / truth.experiments;
    // A variance of so many normal samples has a relative standard error of 1 %.
    EXPECT_NEAR(first, start == NoiseStart::zero ? 0.5 : stationary, 0.04 * first);
    EXPECT_NEAR(y.mean(), 0, 0.07);
    if (start == NoiseStart::stationary) {
      EXPECT_NEAR(y.col(29).squaredNorm() / truth.experiments, stationary, 0.04 * stationary);
    }
  }
}

TEST(Simulate, NoiseDoesNotDependOnTheInput) {
  Truth truth;
  truth.samples = {40000};
  truth.plant.b = VectorXd::Zero(1);
  truth.noise.variance = 1;
  const Experiment experiment = simulateExperiment(truth, 1, 0);
  // The correlation of so many independent pairs has a standard error of 0.005.
  EXPECT_NEAR(experiment.u.dot(experiment.y) / 40000, 0, 0.02);
}

TEST(Simulate, MissingShare) {
  Truth truth = plainTruth();
  truth.samples = {20000};
  truth.sensor.missing = 0.3;
  const Experiment experiment = simulateExperiment(truth, 1, 0);
  EXPECT_NEAR(experiment.validSamples() / 20000.0, 0.7, 0.013);
  for (int k = 0; k < experiment.samples(); ++k) {
    EXPECT_EQ(std::isnan(experiment.y(k)), !experiment.isValid(k));
  }
}

TEST(Simulate, RefusesATruthThatIsNotValid) {
  Truth truth;
  truth.sample_time = 0;
  EXPECT_THROW(simulate(truth, 1), ConfigurationError);
}

}  // namespace
}  // namespace uncertainty_identification
