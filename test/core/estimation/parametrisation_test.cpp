#include "estimation/parametrisation.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Drawn {
  test::RandomSystem system;
  Configuration configuration;
  ModelParameters at;
};

/// A system with n error parameters and kappa components, its mixture obeying the constraint.
Drawn draw(Constraint constraint, int components, int dimension) {
  test::RandomSystemOptions options;
  options.nb = options.na = 2;
  options.taps = constraint == Constraint::zero_static_gain ? dimension + 1 : dimension;
  options.zero_static_gain = constraint == Constraint::zero_static_gain;
  options.components = components;
  options.experiments = 3;
  Drawn drawn{test::randomSystem(options, 12), test::configurationOf(options), {}};
  drawn.configuration.error_model.constraint = constraint;
  drawn.configuration.estimation.offsets = Offsets::estimate;
  drawn.at = test::parametersOf(drawn.system.truth);
  drawn.at.parameters = test::appended(drawn.at.parameters, -0.4);
  if (constraint == Constraint::zero_mean) {
    const VectorXd mean = drawn.at.mixture.mean();
    for (VectorXd& of_component : drawn.at.mixture.means) of_component -= mean;
  }
  return drawn;
}

using ParametrisationShape = std::tuple<Constraint, int, int>;

class Coordinates : public testing::TestWithParam<ParametrisationShape> {
 protected:
  Drawn drawn_ = draw(std::get<0>(GetParam()), std::get<1>(GetParam()), std::get<2>(GetParam()));
  test::CoreSetup setup_{drawn_.configuration, drawn_.system.experiments};
  Parametrisation parametrisation_{setup_.model(), std::get<0>(GetParam()), std::get<1>(GetParam()),
                                   covarianceFloor(drawn_.at.mixture)};
};

TEST_P(Coordinates, RoundTrip) {
  const VectorXd z = parametrisation_.toCoordinates(drawn_.at);
  EXPECT_EQ(z.size(), parametrisation_.size());
  const ModelParameters back = parametrisation_.fromCoordinates(z);
  const VectorXd natural = parametrisation_.natural(drawn_.at);
  EXPECT_EQ(natural.size(), parametrisation_.naturalSize());
  EXPECT_LT((parametrisation_.natural(back) - natural).norm(), 1e-10 * natural.norm());
  EXPECT_EQ(parametrisation_.naturalNames().size(), static_cast<std::size_t>(natural.size()));
}

TEST_P(Coordinates, JacobianMatchesDifferences) {
  const VectorXd z = parametrisation_.toCoordinates(drawn_.at);
  const auto natural = [&](const VectorXd& at) -> VectorXd {
    VectorXd values = parametrisation_.natural(parametrisation_.fromCoordinates(at));
    values[values.size() - 1] = std::log(values[values.size() - 1]);
    return values;
  };
  const MatrixXd expected = test::differences(natural, z), found = parametrisation_.jacobian(z);
  ASSERT_EQ(found.rows(), expected.rows());
  ASSERT_EQ(found.cols(), expected.cols());
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-8);
}

TEST_P(Coordinates, AnyVectorObeysTheConstraints) {
  for (double size : {0.1, 2.0}) {
    const VectorXd z = size * VectorXd::Random(parametrisation_.size());
    const ModelParameters at = parametrisation_.fromCoordinates(z);
    EXPECT_TRUE(setup_.model().admissible(at.parameters));
    EXPECT_NO_THROW(at.mixture.validate("mixture"));
    EXPECT_GT(at.noise_variance, 0);
    if (std::get<0>(GetParam()) == Constraint::zero_mean) {
      EXPECT_LT(at.mixture.mean().norm(), 1e-12);
    }
    for (const MatrixXd& covariance : at.mixture.covariances) {
      const MatrixXd above = covariance - covarianceFloor(drawn_.at.mixture);
      const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(above);
      EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-13 * covariance.norm());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Coordinates,
                         testing::Combine(testing::Values(Constraint::free,
                                                          Constraint::zero_static_gain,
                                                          Constraint::zero_mean),
                                          testing::Values(1, 2, 4), testing::Values(1, 2, 3)));

TEST(Parametrisation, NamesNaturalCoordinates) {
  const Drawn drawn = draw(Constraint::free, 2, 2);
  const test::CoreSetup setup(drawn.configuration, drawn.system.experiments);
  const Parametrisation parametrisation(setup.model(), Constraint::free, 2, MatrixXd::Zero(2, 2));
  EXPECT_EQ(parametrisation.naturalNames(), (std::vector<std::string>{"b1",
                                                                      "b2",
                                                                      "a1",
                                                                      "a2",
                                                                      "c1",
                                                                      "d1",
                                                                      "offset_y",
                                                                      "weight1",
                                                                      "weight2",
                                                                      "mean1[1]",
                                                                      "mean1[2]",
                                                                      "mean2[1]",
                                                                      "mean2[2]",
                                                                      "covariance1[1,1]",
                                                                      "covariance1[2,1]",
                                                                      "covariance1[2,2]",
                                                                      "covariance2[1,1]",
                                                                      "covariance2[2,1]",
                                                                      "covariance2[2,2]",
                                                                      "noise_variance"}));
  EXPECT_EQ(parametrisation.modelCoordinates(), 7);
  const VectorXd values = parametrisation.natural(drawn.at);
  EXPECT_EQ(values[14], drawn.at.mixture.covariances[0](1, 0));
  EXPECT_EQ(values[19], drawn.at.noise_variance);
}

/// Covariances at the floor, or singular without one, have coordinates too.
TEST(Parametrisation, HoldsDegenerateCovariances) {
  Drawn drawn = draw(Constraint::free, 2, 2);
  const test::CoreSetup setup(drawn.configuration, drawn.system.experiments);
  const MatrixXd floor = covarianceFloor(drawn.at.mixture);
  drawn.at.mixture.covariances[0] = floor;
  const Parametrisation floored(setup.model(), Constraint::free, 2, floor);
  const VectorXd z = floored.toCoordinates(drawn.at);
  ASSERT_TRUE(z.allFinite());
  EXPECT_LT((floored.natural(floored.fromCoordinates(z)) - floored.natural(drawn.at)).norm(),
            1e-12);

  drawn.at.mixture.covariances[0] = MatrixXd::Ones(2, 2);
  const Parametrisation plain(setup.model(), Constraint::free, 2, MatrixXd::Zero(2, 2));
  const VectorXd singular = plain.toCoordinates(drawn.at);
  ASSERT_TRUE(singular.allFinite());
  EXPECT_LT((plain.natural(plain.fromCoordinates(singular)) - plain.natural(drawn.at)).norm(),
            1e-7);
}

}  // namespace
}  // namespace uncertainty_identification
