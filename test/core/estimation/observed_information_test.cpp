#include "estimation/observed_information.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class ObservedInformation : public testing::Test {
 protected:
  ObservedInformation() {
    options_.nb = 2;
    options_.experiments = 25;
    options_.missing = 0.05;
    options_.min_samples = options_.max_samples = 80;
    options_.noise_run_up = 200;
    system_ = test::randomSystem(options_, 31);
    for (Experiment& experiment : system_.experiments) {  // all initial states are visible
      experiment.y.head(3).setZero();
      std::fill_n(experiment.valid.begin(), 3, std::uint8_t{1});
    }
    configuration_ = test::configurationOf(options_);
    configuration_.estimation.noise_start = NoiseStart::stationary;
    configuration_.estimation.initial_state = InitialState::estimate;
    configuration_.estimation.offsets = Offsets::estimate;
    at_ = test::parametersOf(system_.truth);
    at_.parameters = test::appended(at_.parameters, 0.01);
  }

  test::RandomSystemOptions options_;
  test::RandomSystem system_;
  Configuration configuration_;
  ModelParameters at_;
};

TEST_F(ObservedInformation, IsTheHessianOfTheLogLikelihood) {
  const test::CoreSetup setup(configuration_, system_.experiments);
  const Parametrisation parametrisation(setup.model(), Constraint::zero_static_gain, 2,
                                        MatrixXd::Zero(1, 1));
  const VectorXd z = parametrisation.toCoordinates(at_);
  const ScoredPoint point = scoredPoint(setup.likelihood(), parametrisation, z);
  EXPECT_EQ(point.log_likelihood, setup.logLikelihood(point.parameters));
  const auto value = [&](const VectorXd& there) {
    return setup.logLikelihood(parametrisation.fromCoordinates(there));
  };
  // second differences of the value, which do not use the gradient
  const Eigen::Index size = z.size();
  const MatrixXd information =
      observedInformation(setup.likelihood(), parametrisation, point, true);
  const VectorXd step = 0.03 * information.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
  MatrixXd hessian(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      const VectorXd si = step[i] * VectorXd::Unit(size, i), sj = step[j] * VectorXd::Unit(size, j);
      const double mixed =
          value(z + si + sj) - value(z + si - sj) - value(z - si + sj) + value(z - si - sj);
      hessian(i, j) = hessian(j, i) = -mixed / (4 * step[i] * step[j]);
    }
  }
  const VectorXd scale = information.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
  const MatrixXd difference = scale.asDiagonal() * (information - hessian) * scale.asDiagonal();
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-3);
  const MatrixXd forward = observedInformation(setup.likelihood(), parametrisation, point, false);
  const MatrixXd less = scale.asDiagonal() * (information - forward) * scale.asDiagonal();
  EXPECT_LT(less.cwiseAbs().maxCoeff(), 0.02);
  EXPECT_EQ(information, information.transpose());
}

TEST_F(ObservedInformation, CountsItsSweeps) {
  const test::CoreSetup setup(configuration_, system_.experiments);
  const Parametrisation parametrisation(setup.model(), Constraint::zero_static_gain, 2,
                                        MatrixXd::Zero(1, 1));
  const ScoredPoint point =
      scoredPoint(setup.likelihood(), parametrisation, parametrisation.toCoordinates(at_));
  const int before = setup.likelihood().passes();
  observedInformation(setup.likelihood(), parametrisation, point, false);
  EXPECT_EQ(setup.likelihood().passes() - before, 6);  // model parameters
}

TEST_F(ObservedInformation, GradientIsTheChainRuleOfTheScores) {
  const test::CoreSetup setup(configuration_, system_.experiments);
  const Parametrisation parametrisation(setup.model(), Constraint::zero_static_gain, 2,
                                        MatrixXd::Zero(1, 1));
  const VectorXd z = parametrisation.toCoordinates(at_);
  const ScoredPoint point = scoredPoint(setup.likelihood(), parametrisation, z);
  const auto value = [&](const VectorXd& there) -> VectorXd {
    return VectorXd::Constant(1, setup.logLikelihood(parametrisation.fromCoordinates(there)));
  };
  const VectorXd expected = test::differences(value, z).transpose();
  EXPECT_LT((point.gradient - expected).norm(), 1e-6 * expected.norm());
}

TEST_F(ObservedInformation, OutsideTheDomainTheLikelihoodIsMinusInfinity) {
  const test::CoreSetup setup(configuration_, system_.experiments);
  const Parametrisation parametrisation(setup.model(), Constraint::zero_static_gain, 2,
                                        MatrixXd::Zero(1, 1));
  VectorXd z = parametrisation.toCoordinates(at_);
  z[0] = std::nan("");
  EXPECT_EQ(scoredPoint(setup.likelihood(), parametrisation, z).log_likelihood, -INFINITY);
  z = parametrisation.toCoordinates(at_);
  z[z.size() - 1] = 800;  // a noise variance that overflows
  EXPECT_EQ(scoredPoint(setup.likelihood(), parametrisation, z).log_likelihood, -INFINITY);
}

}  // namespace
}  // namespace uncertainty_identification
