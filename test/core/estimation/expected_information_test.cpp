#include "estimation/expected_information.h"

#include <gtest/gtest.h>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Separate components, each with about 100 of 200 experiments whose samples all but show xi.
ModelParameters separateComponents(const test::RandomSystemOptions& options,
                                   test::RandomSystem* system) {
  *system = test::randomSystem(options, 3);
  system->truth.noise_variance = 1e-3;
  system->truth.mixture = {{0.4, 0.6},
                           {VectorXd::Constant(1, -2), VectorXd::Constant(1, 2)},
                           {MatrixXd::Constant(1, 1, 0.2), MatrixXd::Constant(1, 1, 0.1)}};
  *system = test::simulateSystem(system->truth, options, 4);
  return test::parametersOf(system->truth);
}

/// At the truth the expected and the observed information differ by the noise of 200 experiments:
/// 3 * sqrt(2/80), 0.5, for the variance of the smaller component.
TEST(ExpectedInformation, IsTheMeanOfTheObservedOne) {
  test::RandomSystemOptions options;
  options.experiments = 200;
  test::RandomSystem system;
  const ModelParameters truth = separateComponents(options, &system);
  const test::CoreSetup setup(test::configurationOf(options), system.experiments);
  const Parametrisation parametrisation(setup.model(), Constraint::zero_static_gain, 2,
                                        MatrixXd::Zero(1, 1));
  const ScoredPoint point =
      scoredPoint(setup.likelihood(), parametrisation, parametrisation.toCoordinates(truth));
  const Expectation e = setup.likelihood().expect(point.statistics, point.parameters);
  const VectorXd observed =
      observedInformation(setup.likelihood(), parametrisation, point, true).diagonal();
  const MatrixXd of_model = expectedModelInformation(setup.likelihood(), parametrisation, point, e);
  const VectorXd of_mixture = expectedMixtureInformation(parametrisation, point, e);
  ASSERT_EQ(of_model.rows(), 4);
  ASSERT_EQ(of_mixture.size(), observed.size() - 5);
  for (Index j = 0; j < of_mixture.size(); ++j)
    EXPECT_NEAR(of_mixture[j] / observed[4 + j], 1, 0.5) << "mixture coordinate " << j;
  for (const Index noise : {2, 3})  // xi tells nothing about C and D
    EXPECT_NEAR(of_model(noise, noise) / observed[noise], 1, 0.1) << "parameter " << noise;
}

/// y = b u + omega, one experiment: the information is u'u / sigma^2, whatever the residuals.
TEST(ExpectedInformation, OfOneRegressionIsKnown) {
  test::RandomSystemOptions options;
  options.na = options.nc = options.nd = options.taps = 0;
  options.experiments = 1;
  const auto system = test::randomSystem(options, 3);
  const test::CoreSetup setup(test::configurationOf(options), system.experiments);
  const Parametrisation parametrisation(setup.model(), Constraint::free, 1, MatrixXd(0, 0));
  const ModelParameters truth = test::parametersOf(system.truth);
  const ScoredPoint point =
      scoredPoint(setup.likelihood(), parametrisation, parametrisation.toCoordinates(truth));
  const MatrixXd information =
      expectedModelInformation(setup.likelihood(), parametrisation, point,
                               setup.likelihood().expect(point.statistics, point.parameters));
  const VectorXd& u = system.experiments[0].u;
  const double expected = u.head(u.size() - 1).squaredNorm() / truth.noise_variance;
  EXPECT_NEAR(information(0, 0), expected, 1e-9 * expected);
}

}  // namespace
}  // namespace uncertainty_identification
