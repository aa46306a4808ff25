// The methods that the stochastic embedding is compared with, on the paper's Example 2.
#include "uncertainty_identification/baselines/baseline.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>

#include "io/baseline_binding.h"
#include "io/tree_reader.h"
#include "io/tree_writer.h"
#include "io/truth_yaml.h"
#include "simulation/simulate.h"
#include "support/core_setup.h"
#include "support/error_message.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/configuration_yaml.h"

namespace uncertainty_identification {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::uint64_t kSeed = 3;
constexpr int kExperiments = 60;

Truth truth() {
  Truth made = loadTruth(std::string(PROJECT_FOLDER) + "/config/example2_truth.yaml");
  made.experiments = kExperiments;
  return made;
}

Configuration configuration() {
  Configuration made = loadConfiguration(std::string(PROJECT_FOLDER) + "/config/example2.yaml");
  made.bounds.frequencies = 40;
  made.bounds.levels = {0.5, 0.9, 0.99};
  return made;
}

double pole(int r) { return -drawSystem(truth(), kSeed, r).polynomials.a[0]; }

TEST(PredictionError, EachExperimentGivesItsOwnTimeConstant) {
  const BaselineResult result =
      identifyBaseline(BaselineMethod::pem, configuration(), simulate(truth(), kSeed));
  ASSERT_EQ(result.baseline.fits.size(), static_cast<std::size_t>(kExperiments));
  int covered = 0;
  double sum = 0, noise = 0;
  for (int r = 0; r < kExperiments; ++r) {
    const ExperimentFit& fit = result.baseline.fits[static_cast<std::size_t>(r)];
    const double drawn = drawSystem(truth(), kSeed, r).time_constant.value();
    const double error = fit.parameters[0].value - drawn;
    EXPECT_LT(std::abs(error), 5 * fit.parameters[0].standard_error) << r;
    if (std::abs(error) < 1.96 * fit.parameters[0].standard_error) ++covered;
    sum += fit.parameters[0].value / kExperiments;
    noise += fit.noise_variance / kExperiments;
  }
  EXPECT_GE(covered, 50);  // 95 % of 60 are 57; below 50 by chance once in 10^4
  EXPECT_NEAR(result.baseline.mean[0], sum, 1e-15);
  EXPECT_EQ(result.estimate.nominal_model.parameters[0].value, result.baseline.mean[0]);
  EXPECT_NEAR(result.estimate.noise_variance.value, noise, 1e-12);
  // 1 % smaller than 0.1, one of 100 degrees of freedom being taken by tau
  EXPECT_NEAR(noise, 0.099, 4 * result.estimate.noise_variance.standard_error);
  // uniform within 40 %: 0.4/sqrt(3) of 10 ms; its own error is 8 % for 60 draws
  EXPECT_NEAR(result.baseline.deviation[0], 0.004 / std::sqrt(3.0), 4 * 0.08 * 0.0023);
  EXPECT_NEAR(result.estimate.nominal_model.parameters[0].standard_error,
              result.baseline.deviation[0] / std::sqrt(kExperiments), 1e-12);
}

TEST(PredictionError, TheMeansCovarianceReachesThePlant) {
  const BaselineResult result =
      identifyBaseline(BaselineMethod::pem, configuration(), simulate(truth(), kSeed));
  ASSERT_EQ(result.estimate.joint_covariance.rows(), 2);
  const NominalModelEstimate& go = result.estimate.nominal_model;
  // b = 1 - p with p = exp(-Ts/tau): db/dtau = -p Ts/tau^2
  const double tau = go.parameters[0].value, p = -go.a[0];
  EXPECT_NEAR(std::sqrt(result.estimate.joint_covariance(0, 0)),
              p * 0.01 / (tau * tau) * go.parameters[0].standard_error, 1e-6);
}

/// The region of the single fits: the quantiles of their poles, since |G| falls with the pole.
TEST(PredictionError, BandsHoldTheShareOfPlantsThatTheyName) {
  const Baseline baseline =
      identifyBaseline(BaselineMethod::pem, configuration(), simulate(truth(), kSeed)).baseline;
  ASSERT_EQ(baseline.omega.size(), 40);
  ASSERT_EQ(baseline.magnitude_bands.pointwise.size(), 2u);  // 60 plants cannot tell 99 %
  const Band& band = baseline.magnitude_bands.pointwise[1];
  EXPECT_EQ(band.level, 0.9);
  const double angle = baseline.omega[25] * 0.01;
  int inside = 0;
  for (int r = 0; r < kExperiments; ++r) {
    const double magnitude = (1 - pole(r)) / std::abs(1.0 - pole(r) * std::polar(1.0, -angle));
    if (magnitude >= band.lower[25] && magnitude <= band.upper[25]) ++inside;
  }
  // 54 of 60, less what the fits' own errors move across the limits
  EXPECT_GE(inside, 48);
  EXPECT_LE(inside, 59);
}

TEST(PredictionError, WhatCannotBeFittedIsListed) {
  std::vector<Experiment> experiments = simulate(truth(), kSeed);
  experiments.resize(4);
  experiments[2].u.setZero();  // refused by the checks
  experiments.push_back(experiments[0]);
  experiments.back().id = "short";
  experiments.back().u.conservativeResize(30);
  experiments.back().y.conservativeResize(30);
  experiments.back().y.setConstant(1e200);
  const BaselineResult result = identifyBaseline(BaselineMethod::pem, configuration(), experiments);
  EXPECT_EQ(result.baseline.fits.size(), 3u);
  EXPECT_EQ(result.estimate.rejected.size(), 2u);
  experiments.resize(1);
  EXPECT_THROW(identifyBaseline(BaselineMethod::pem, configuration(), experiments), DataError);
  Configuration automatic = configuration();
  automatic.nominal_model = NominalModelOptions();
  automatic.nominal_model.orders_auto = true;
  EXPECT_NE(messageOf<ConfigurationError>([&] {
              identifyBaseline(BaselineMethod::pem, automatic, simulate(truth(), kSeed));
            }).find("nominal_model.orders"),
            std::string::npos);
}

/// With white noise an FIR model's estimate is least squares on what Go leaves.
TEST(ModelErrorModel, IsLeastSquaresOnTheResidual) {
  const std::vector<Experiment> experiments = simulate(truth(), kSeed);
  const BaselineResult result = identifyBaseline(BaselineMethod::mem, configuration(), experiments);
  const double p = -result.estimate.nominal_model.a[0];
  ASSERT_EQ(result.baseline.error_models.size(), experiments.size());
  for (std::size_t r : {0u, 31u}) {
    const Experiment& experiment = experiments[r];
    const Eigen::Index N = experiment.samples();
    VectorXd residual = experiment.y;
    double x = 0;
    for (Eigen::Index t = 1; t < N; ++t) {
      x = p * x + (1 - p) * experiment.u[t - 1];
      residual[t] -= x;
    }
    MatrixXd A = MatrixXd::Zero(N, kModelErrorOrder);
    for (Eigen::Index k = 0; k < kModelErrorOrder; ++k)
      A.col(k).tail(N - 1 - k) = experiment.u.head(N - 1 - k);
    const VectorXd expected = (A.transpose() * A).ldlt().solve(A.transpose() * residual);
    EXPECT_LT((result.baseline.error_models[r].b - expected).norm(), 1e-4 * expected.norm());
  }
}

TEST(ModelErrorModel, PlantsAreGoPlusTheErrorModels) {
  ModelErrorModels models;
  models.nominal.delay = 1;
  models.nominal.b = test::vectorOf({0.6});
  models.nominal.a = test::vectorOf({-0.4, 0.1});
  ExperimentFit fit;
  fit.b = test::vectorOf({0.1, -0.2, 0.05});
  models.fits = {fit, fit};
  models.fits[1].b *= -1;
  const VectorXd omega = test::vectorOf({1.0, 30.0, 200.0});
  const PlantSamples plants = plantsOf(models, 0.01);
  const ComplexResponses found = frequencyResponses(plants, omega);
  for (Eigen::Index k = 0; k < omega.size(); ++k) {
    const std::complex<double> z = std::polar(1.0, -0.01 * omega[k]);
    const std::complex<double> go = 0.6 / (1.0 - 0.4 * z + 0.1 * z * z);
    const std::complex<double> e = 0.1 - 0.2 * z + 0.05 * z * z;
    for (int r = 0; r < 2; ++r) {
      const std::complex<double> expected = r == 0 ? go + e : go - e;
      EXPECT_LT(std::abs(std::complex<double>(found.real(r, k), found.imaginary(r, k)) - expected),
                1e-12);
    }
  }
}

TEST(BaselineJson, RoundTripKeepsEveryBit) {
  std::vector<Experiment> experiments = simulate(truth(), kSeed);
  experiments.resize(25);
  const Baseline baseline =
      identifyBaseline(BaselineMethod::mem, configuration(), experiments).baseline;
  const nlohmann::json tree = writtenTree(baseline);
  EXPECT_EQ(tree["method"], "mem");
  EXPECT_EQ(tree["experiments"].size(), 25u);
  EXPECT_EQ(tree["error_models"][0]["b"].size(), 10u);
  EXPECT_EQ(writtenTree(readRecord<Baseline>(nlohmann::json::parse(tree.dump()))), tree);
  nlohmann::json truncated = tree;
  truncated.erase("deviation");
  EXPECT_NE(
      messageOf<ConfigurationError>([&] { readRecord<Baseline>(truncated); }).find("deviation"),
      std::string::npos);
}

}  // namespace
}  // namespace uncertainty_identification
